use super::random::{Random, policy};
use btc::logic::*;
use btc::tree::decanonicalise::{Care, Method, decanonicalise};
#[test]
fn time_it() {
    let mut tot = (0.0, 0.0);
    for seed in 1..=400 {
        let policy = policy(seed);
        let t = std::time::Instant::now();
        let _ = decanonicalise(&policy, Method::Paper, Care::Seen);
        let a = t.elapsed();
        let t = std::time::Instant::now();
        let _ = decanonicalise(&policy, Method::Search, Care::Seen);
        let b = t.elapsed();
        tot.0 += a.as_secs_f64();
        tot.1 += b.as_secs_f64();
        if b.as_millis() > 60 {
            println!(
                "{seed}: {:?} {:?} rows {} atoms {}",
                a,
                b,
                policy.rows.len(),
                policy.atoms.len()
            );
        }
    }
    println!("total {tot:?}");
    for seed in 1..=300u64 {
        let random = &mut Random::new(seed);
        let atoms = 1 + random.below(16);
        let rows = 1 + random.below(120);
        let (columns, on, off) = super::guards::table(random, atoms, rows);
        let t = std::time::Instant::now();
        let c = minimise(&columns, &on, &off);
        let e = t.elapsed();
        if e.as_millis() > 8 {
            println!(
                "min {seed} {atoms} {} {e:?} {}",
                columns.rows(),
                c.cubes().len()
            );
        }
    }
}
