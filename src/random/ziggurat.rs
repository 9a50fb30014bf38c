//! Gaussian numbers from a stack of layers of equal area under the bell curve: nearly always one random word, one
//! comparison and one product.

use super::{Bits, fraction};
use crate::math;
use std::sync::LazyLock;

/// The number of layers.
const LAYERS: usize = 128;
/// Where the tail begins, for this number of layers.
const TAIL: f64 = 3.442_619_855_899;
/// The area of a layer under exp(−x²/2).
const AREA: f64 = 9.912_563_035_262_17e-3;

/// The layers.
#[derive(Debug)]
pub(super) struct Ziggurat {
    /// For each layer from the bottom its width, and the part of it that is under the curve over its whole height.
    layers: [(f64, f64); LAYERS],
}

static ZIGGURAT: LazyLock<Ziggurat> = LazyLock::new(Ziggurat::build);

fn bell(x: f64) -> f64 {
    math::exp(-0.5 * x * x)
}

impl Ziggurat {
    pub(super) fn get() -> &'static Self {
        &ZIGGURAT
    }

    fn build() -> Self {
        let mut layers = [(0.0, 0.0); LAYERS];
        // The lowest layer is as wide as a rectangle of its area, tail included, would be.
        let mut width = AREA / bell(TAIL);
        let mut next = TAIL;
        for (i, layer) in layers.iter_mut().enumerate() {
            *layer = (width, next / width);
            width = next;
            next = if i + 2 < LAYERS {
                (-2.0 * math::ln(AREA / width + bell(width))).sqrt()
            } else {
                0.0
            };
        }
        Self { layers }
    }

    #[inline]
    #[allow(
        clippy::indexing_slicing,
        reason = "a remainder by the number of layers is one of them"
    )]
    pub(super) fn draw(&self, bits: &mut Bits) -> f64 {
        loop {
            let word = bits.word();
            let (width, inner) = self.layers[word as usize % LAYERS];
            let u = 2.0 * fraction(word) - 1.0;
            if u.abs() < inner {
                return u * width;
            }
            if let Some(value) = self.edge(word as usize % LAYERS, u, bits) {
                return value;
            }
        }
    }

    /// Beyond the part of a layer that is under the curve: the tail, or a try against the curve.
    #[cold]
    fn edge(&self, layer: usize, u: f64, bits: &mut Bits) -> Option<f64> {
        if layer == 0 {
            return Some(tail(bits).copysign(u));
        }
        let &(width, inner) = self.layers.get(layer)?;
        let x = u * width;
        let (low, high) = (bell(width), bell(inner * width));
        (low + bits.unit() * (high - low) < bell(x)).then_some(x)
    }
}

/// A number of the tail (Marsaglia 1964).
fn tail(bits: &mut Bits) -> f64 {
    loop {
        // 1 − u is never zero.
        let x = -math::ln(1.0 - bits.unit()) / TAIL;
        let y = -math::ln(1.0 - bits.unit());
        if 2.0 * y >= x * x {
            return TAIL + x;
        }
    }
}
