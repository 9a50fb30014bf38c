//! What the examples print: what is learned with five seeds, and what it returns in fresh episodes.

use btc::{Environment, LearnOptions, Trainer};

/// Learns with seeds 1 to 5, each with about `effort` steps to grow a tree; prints the first tree and the figures of all.
pub fn show<E: Environment, F: Fn() -> E + Sync + Send>(
    trainer: &Trainer<F>,
    effort: u64,
) -> Result<(), btc::Error> {
    for seed in 1..=5 {
        let options = LearnOptions {
            seed: Some(seed),
            roll_outs: 200,
            effort,
            ..LearnOptions::default()
        };
        let trained = trainer.learn(&options)?;
        if seed == 1 {
            println!("{}", trained.tree());
        }
        let returns = trainer.play(trained.tree(), 1000, seed)?;
        println!(
            "seed {seed}: {} nodes, the exact tree {}; a return of {:.3} in 1000 fresh episodes, from {} to {}",
            trained.tree().size().nodes,
            trained.exact().size().nodes,
            returns.iter().sum::<f64>() / 1000.0,
            returns.iter().copied().fold(f64::INFINITY, f64::min),
            returns.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        );
    }
    Ok(())
}
