//! Pseudorandom numbers, the same on every machine.

/// The next of a sequence (splitmix64: Steele, Lea and Flood 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number.
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// The next number below `bound`; 0 where nothing is.
    pub fn below(&mut self, bound: usize) -> usize {
        match bound {
            0 => 0,
            bound => (self.next() % bound as u64) as usize,
        }
    }
}

/// `size` of the numbers, spread evenly, or all if there are no more. Of each stretch one is taken at random, so that no
/// period in the numbers shows.
pub(in crate::logic) fn sample(
    numbers: impl Iterator<Item = usize>,
    count: usize,
    size: usize,
    random: &mut Random,
) -> Vec<usize> {
    if count <= size {
        return numbers.collect();
    }
    let mut wanted = (0..size).map(|i| {
        let (from, to) = (i * count / size, (i + 1) * count / size);
        from + random.below(to - from)
    });
    let mut next = wanted.next();
    let picked = numbers.enumerate().filter(|(at, _)| {
        let hit = Some(*at) == next;
        if hit {
            next = wanted.next();
        }
        hit
    });
    picked.map(|(_, number)| number).collect()
}
