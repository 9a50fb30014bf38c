//! Where sweeps come to rest: generalised conjugate residuals (Eisenstat, Elman and Schultz 1983) on what they change.
//!
//! A sweep is v ↦ M v + b. Where little is discounted it takes away a small part of what is left to change, and thousands
//! would be needed. So what a sweep changes is a direction; of all directions so far that step is taken after which the
//! next sweep changes least.

use nalgebra::DVector;

/// The directions that are kept at a time, and how often they are begun anew.
const DIRECTIONS: usize = 16;
const CYCLES: usize = 120;
/// What is left to change is reckoned on the way. It is looked at when it seems to be this part of what may be left.
const SEEMS: f64 = 0.1;
/// A direction of which a sweep leaves all but this part leads nowhere.
const LEADS: f64 = 1e-10;
/// What is left to change after some directions is at most this part of what was left before. Where it is more, it is rounding if
/// it is at most this part of the greatest value; else the sum has no end.
const SHRINKS: f64 = 0.9;
const ROUNDING: f64 = 1e-8;

/// A direction, and what of it a sweep takes away, which has length one.
struct Way {
    step: DVector<f64>,
    taken: DVector<f64>,
}

/// The values that a sweep changes by less than `least` says of them; `None` where there are none or they are not found. `sweep` is one
/// sweep, `change` what a sweep makes of a change of the values.
pub fn found(
    values: Vec<f64>,
    sweep: impl Fn(&mut [f64]),
    change: impl Fn(&mut [f64]),
    least: impl Fn(&[f64]) -> f64,
) -> Option<Vec<f64>> {
    let mut values = DVector::from_vec(values);
    let mut before = f64::INFINITY;
    for _ in 0..CYCLES {
        let mut swept = values.clone();
        sweep(swept.as_mut_slice());
        let mut left = &swept - &values;
        let least = least(swept.as_slice());
        let now = left.amax();
        let shrinks = now < SHRINKS * before;
        if now < least || !shrinks && now < ROUNDING * swept.amax() {
            return Some(swept.as_slice().to_vec());
        }
        if !shrinks {
            return None;
        }
        before = now;
        let mut ways: Vec<Way> = Vec::new();
        while ways.len() < DIRECTIONS && left.amax() >= SEEMS * least {
            let Some(way) = next(&left, &ways, &change) else {
                break;
            };
            let length = left.dot(&way.taken);
            values.axpy(length, &way.step, 1.0);
            left.axpy(-length, &way.taken, 1.0);
            ways.push(way);
        }
    }
    None
}

/// The direction of what is left to change, beside those that are known.
fn next(left: &DVector<f64>, ways: &[Way], change: impl Fn(&mut [f64])) -> Option<Way> {
    let mut step = left.clone();
    let mut kept = left.clone();
    change(kept.as_mut_slice());
    let mut taken = &step - kept;
    for way in ways {
        let part = taken.dot(&way.taken);
        taken.axpy(-part, &way.taken, 1.0);
        step.axpy(-part, &way.step, 1.0);
    }
    let length = taken.norm();
    let leads = length > LEADS * step.norm();
    (leads && length.is_finite()).then(|| Way {
        step: step / length,
        taken: taken / length,
    })
}
