//! The random numbers are what they are said to be.

use btc::random::Random;
use statrs::distribution::{ContinuousCDF, Normal};

/// The greatest distance between the distribution of a million draws and the normal one (Kolmogorov).
#[test]
fn gaussian_numbers_are_gaussian() {
    let mut random = Random::new(3, 1, 4);
    let n = 1_000_000;
    let mut draws: Vec<_> = (0..n).map(|_| random.gaussian()).collect();
    draws.sort_by(f64::total_cmp);
    let normal = Normal::new(0.0, 1.0).unwrap();
    let distance = draws
        .iter()
        .enumerate()
        .map(|(i, &x)| (normal.cdf(x) - (i as f64 + 0.5) / f64::from(n)).abs())
        .fold(0.0, f64::max);
    // Exceeded once in a thousand seeds.
    assert!(distance < 1.95 / f64::from(n).sqrt(), "{distance}");
    let beyond = draws.iter().filter(|x| x.abs() > 3.5).count();
    assert!((400..530).contains(&beyond), "465 expected, {beyond} found");
}

#[test]
fn episodes_and_streams_differ() {
    let first = |seed, stream, episode| Random::new(seed, stream, episode).word();
    let words = [
        first(1, 0, 0),
        first(0, 1, 0),
        first(0, 0, 1),
        first(1, 1, 0),
        first(1, 0, 1),
        first(0, 0, 0),
    ];
    for (i, word) in words.iter().enumerate() {
        assert!(!words[..i].contains(word));
    }
}

#[test]
fn small_ranges_are_even() {
    let mut random = Random::new(1, 2, 3);
    let mut counts = [0; 3];
    for _ in 0..30_000 {
        counts[random.below(3) as usize] += 1;
    }
    assert!(counts.iter().all(|count| (9_700..10_300).contains(count)));
    assert_eq!(random.below(0), 0);
}
