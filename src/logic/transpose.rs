//! Rows of bits into columns of bits.

use super::bits::Bits;

/// The columns of `count` rows, each given in machine words, column 0 in the lowest bit of the first; missing words are 0.
pub(super) fn transpose<'a>(
    columns: usize,
    count: usize,
    rows: impl Iterator<Item = &'a [u64]>,
) -> Vec<Bits> {
    let mut words: Vec<Vec<u64>> = vec![Vec::with_capacity(count.div_ceil(64)); columns];
    let mut blocks = vec![[0_u64; 64]; columns.div_ceil(64)];
    let mut filled = 0;
    let mut flush = |blocks: &mut [[u64; 64]]| {
        for (columns, block) in words.chunks_mut(64).zip(blocks) {
            square(block);
            for (column, word) in columns.iter_mut().zip(*block) {
                column.push(word);
            }
            *block = [0; 64];
        }
    };
    for row in rows.take(count) {
        for (block, word) in blocks.iter_mut().zip(row) {
            if let Some(slot) = block.get_mut(filled) {
                *slot = *word;
            }
        }
        filled += 1;
        if filled == 64 {
            flush(&mut blocks);
            filled = 0;
        }
    }
    if filled > 0 {
        flush(&mut blocks);
    }
    let bits = |words| Bits::from_words(count, words);
    words.into_iter().map(bits).collect()
}

/// Transposes 64 × 64 bits by swapping halves, quarters, … down to single bits.
fn square(block: &mut [u64; 64]) {
    let mut width = 32;
    let mut mask = u64::MAX >> 32;
    while width > 0 {
        for pair in block.chunks_exact_mut(2 * width) {
            let (low, high) = pair.split_at_mut(width);
            for (low, high) in low.iter_mut().zip(high) {
                let swap = (*low >> width ^ *high) & mask;
                *high ^= swap;
                *low ^= swap << width;
            }
        }
        width /= 2;
        mask ^= mask << width;
    }
}
