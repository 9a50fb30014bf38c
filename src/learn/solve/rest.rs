//! Where sweeps come to rest: generalised conjugate residuals (Eisenstat, Elman and Schultz 1983) on what they change.
//!
//! A sweep is v ↦ M v + b. Where little is discounted it takes away a small part of what is left to change, and thousands
//! would be needed. So what a sweep changes is a direction; of all directions so far that step is taken after which the
//! next sweep changes least.

use nalgebra::DVector;

/// The directions that are kept at a time before they are begun anew.
const DIRECTIONS: usize = 40;
/// What is left to change is reckoned on the way. It is looked at when it seems to be this part of what may be left.
const SEEMS: f64 = 0.1;
/// A direction of which a sweep leaves all but this part leads nowhere.
const LEADS: f64 = 1e-14;
/// What is left to change is rounding where all directions leave more than this part of it, and it is at most this part of the
/// greatest value.
const SHRINKS: f64 = 0.9;
const ROUNDING: f64 = 1e-13;

/// A direction, and what of it a sweep takes away, which has length one.
struct Way {
    step: DVector<f64>,
    taken: DVector<f64>,
}

/// The values that a sweep changes by less than `least` says of them, or those after so many times all directions. `sweep` is one
/// sweep, `change` what a sweep makes of a change of the values.
pub fn found(
    values: Vec<f64>,
    sweep: impl Fn(&mut [f64]),
    change: impl Fn(&mut [f64]),
    least: impl Fn(&[f64]) -> f64,
    times: usize,
) -> Vec<f64> {
    let mut values = DVector::from_vec(values);
    let mut found = values.clone();
    let mut before = f64::INFINITY;
    for _ in 0..=times {
        let mut swept = values.clone();
        sweep(swept.as_mut_slice());
        let mut left = &swept - &values;
        let now = left.amax();
        if !left.norm().is_finite() {
            break;
        }
        let least = least(swept.as_slice());
        let is_rounding = now >= SHRINKS * before && now < ROUNDING * swept.amax();
        found = swept;
        if now < least || is_rounding {
            break;
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
    found.as_slice().to_vec()
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
