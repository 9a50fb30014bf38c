//! Truth tables: a circuit evaluated for 512 valuations at a time.

use super::{Circuit, Gate, Signal};

/// Machine words that are evaluated together.
const LANES: usize = 8;

type Block = [u64; LANES];

/// The values of the last six inputs in the 64 valuations of a word.
const PATTERNS: [u64; 6] = [
    0xaaaa_aaaa_aaaa_aaaa,
    0xcccc_cccc_cccc_cccc,
    0xf0f0_f0f0_f0f0_f0f0,
    0xff00_ff00_ff00_ff00,
    0xffff_0000_ffff_0000,
    0xffff_ffff_0000_0000,
];

/// The least valuation of `inputs` in which the goal holds: the first input decides first, false before true. Inputs
/// that the goal does not depend on are false. It takes time for up to 2^n valuations of the n that it does depend on.
pub(in crate::tree) fn least(
    circuit: &Circuit,
    goal: Signal,
    inputs: &[Signal],
) -> Option<Vec<bool>> {
    let table = Table::new(circuit, goal, inputs);
    let at = table.first()?;
    let mut digit = table.read.len();
    let value = |reads: &bool| {
        digit -= usize::from(*reads);
        *reads && at >> digit & 1 == 1
    };
    Some(table.reads.iter().map(value).collect())
}

/// A conjunction of two earlier values, each flipped by a mask.
struct Step {
    left: (usize, u64),
    right: (usize, u64),
}

/// The cone of a signal, ready to be evaluated.
struct Table {
    /// Whether each input is read.
    reads: Vec<bool>,
    /// Where the values of those that are stand, from the first.
    read: Vec<usize>,
    /// What is computed behind them.
    steps: Vec<Step>,
    /// How many values stand before those of the steps.
    given: usize,
    goal: (usize, u64),
}

impl Table {
    fn new(circuit: &Circuit, goal: Signal, inputs: &[Signal]) -> Self {
        let cone = circuit.cone(&[goal]);
        let reads = circuit.reads(&cone, inputs);
        let is_gate = |gate: &usize| matches!(circuit.gates.get(*gate), Some(Gate::And(..)));
        let (steps, given): (Vec<usize>, Vec<usize>) = cone.into_iter().partition(is_gate);
        let mut places = vec![0; circuit.gates.len()];
        for (place, gate) in given.iter().chain(&steps).enumerate() {
            if let Some(slot) = places.get_mut(*gate) {
                *slot = place;
            }
        }
        let operand = |signal: Signal| {
            let mask = if signal.is_negated() { u64::MAX } else { 0 };
            (places.get(signal.gate()).copied().unwrap_or(0), mask)
        };
        let read = inputs.iter().zip(&reads).filter(|(_, reads)| **reads);
        Self {
            read: read.map(|(input, _)| operand(*input).0).collect(),
            steps: steps
                .iter()
                .filter_map(|gate| match circuit.gates.get(*gate)? {
                    Gate::And(a, b) => Some(Step {
                        left: operand(*a),
                        right: operand(*b),
                    }),
                    Gate::False | Gate::Input => None,
                })
                .collect(),
            given: given.len(),
            goal: operand(goal),
            reads,
        }
    }

    /// The number of the first valuation in which the goal holds; the last input that is read is its lowest digit.
    #[allow(
        clippy::indexing_slicing,
        reason = "steps read what stands before them, and places are those of `values`"
    )]
    fn first(&self) -> Option<u64> {
        let mut values: Vec<Block> = vec![[0; LANES]; self.given + self.steps.len()];
        let digits = self.read.len() as u32;
        let per_block = (64 * LANES as u64).trailing_zeros();
        let blocks = 1u64 << digits.saturating_sub(per_block);
        for block in 0..blocks {
            for (digit, place) in self.read.iter().rev().enumerate() {
                values[*place] = pattern(digit, block);
            }
            for (k, step) in self.steps.iter().enumerate() {
                let (before, after) = values.split_at_mut(self.given + k);
                let (a, b) = (&before[step.left.0], &before[step.right.0]);
                for (lane, value) in after[0].iter_mut().enumerate() {
                    *value = (a[lane] ^ step.left.1) & (b[lane] ^ step.right.1);
                }
            }
            let goal = &values[self.goal.0];
            if let Some(lane) = (0..LANES).find(|lane| goal[*lane] ^ self.goal.1 != 0) {
                let bit = (goal[lane] ^ self.goal.1).trailing_zeros();
                return Some(block << per_block | (lane as u64) << 6 | u64::from(bit));
            }
        }
        None
    }
}

/// The values of the input with this digit in a block of valuations.
fn pattern(digit: usize, block: u64) -> Block {
    if let Some(word) = PATTERNS.get(digit) {
        return [*word; LANES];
    }
    let of = |lane: usize| match (block << LANES.trailing_zeros() | lane as u64) >> (digit - 6) & 1
    {
        1 => u64::MAX,
        _ => 0,
    };
    std::array::from_fn(of)
}
