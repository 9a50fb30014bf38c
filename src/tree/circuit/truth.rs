//! Truth tables: a circuit evaluated for 512 valuations at a time.
//!
//! Valuations are numbered: the last input is the lowest digit, so that they are counted in the order of minterms.

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
    let cone = circuit.cone(&[goal]);
    let reads = circuit.reads(&cone, inputs);
    let read = inputs.iter().zip(&reads).filter(|(_, reads)| **reads);
    let read: Vec<Signal> = read.map(|(input, _)| *input).collect();
    let mut compiled = Compiled::new(circuit, &cone, goal, &read);
    let at = (0..compiled.blocks()).find_map(|number| {
        let block = compiled.block(number);
        let lane = block.iter().position(|word| *word != 0)?;
        let bit = block.get(lane)?.trailing_zeros();
        Some(number * 64 * LANES as u64 + 64 * lane as u64 + u64::from(bit))
    })?;
    let mut digit = read.len();
    let value = |reads: &bool| {
        digit -= usize::from(*reads);
        *reads && at >> digit & 1 == 1
    };
    Some(reads.iter().map(value).collect())
}

/// Whether the signal holds in each of the valuations of `inputs`, a bit each; bits past the last repeat the first.
pub(in crate::tree) fn column(circuit: &Circuit, signal: Signal, inputs: &[Signal]) -> Vec<u64> {
    let mut compiled = Compiled::new(circuit, &circuit.cone(&[signal]), signal, inputs);
    let blocks = 0..compiled.blocks();
    blocks.flat_map(|number| compiled.block(number)).collect()
}

/// A conjunction of two earlier values, each flipped by a mask.
struct Conjunction {
    left: (usize, u64),
    right: (usize, u64),
}

/// The cone of a signal, ready to be evaluated.
struct Compiled {
    /// Where the value of each input stands, from the first, if it is read.
    inputs: Vec<Option<usize>>,
    /// The gates, each behind those that it reads.
    steps: Vec<Conjunction>,
    goal: (usize, u64),
    values: Vec<Block>,
}

impl Compiled {
    fn new(circuit: &Circuit, cone: &[usize], goal: Signal, inputs: &[Signal]) -> Self {
        let is_gate = |gate: &usize| matches!(circuit.gates.get(*gate), Some(Gate::And(..)));
        let (steps, given): (Vec<usize>, Vec<usize>) =
            cone.iter().copied().partition(|gate| is_gate(gate));
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
        let reads = circuit.reads(cone, inputs);
        let inputs = inputs.iter().zip(reads);
        Self {
            inputs: inputs
                .map(|(input, reads)| reads.then(|| operand(*input).0))
                .collect(),
            values: vec![[0; LANES]; given.len() + steps.len()],
            steps: steps
                .iter()
                .filter_map(|gate| match circuit.gates.get(*gate)? {
                    Gate::And(a, b) => Some(Conjunction {
                        left: operand(*a),
                        right: operand(*b),
                    }),
                    Gate::False | Gate::Input => None,
                })
                .collect(),
            goal: operand(goal),
        }
    }

    /// How many blocks hold all valuations.
    fn blocks(&self) -> u64 {
        let per_block = (64 * LANES).trailing_zeros() as usize;
        1 << self.inputs.len().saturating_sub(per_block)
    }

    /// Whether the goal holds in the valuations of a block.
    #[allow(
        clippy::indexing_slicing,
        reason = "steps read what stands before them, and places are those of `values`"
    )]
    fn block(&mut self, number: u64) -> Block {
        for (digit, place) in self.inputs.iter().rev().enumerate() {
            if let Some(place) = place {
                self.values[*place] = pattern(digit, number);
            }
        }
        let given = self.values.len() - self.steps.len();
        for (k, step) in self.steps.iter().enumerate() {
            let (before, after) = self.values.split_at_mut(given + k);
            let (a, b) = (&before[step.left.0], &before[step.right.0]);
            for (lane, value) in after[0].iter_mut().enumerate() {
                *value = (a[lane] ^ step.left.1) & (b[lane] ^ step.right.1);
            }
        }
        self.values[self.goal.0].map(|word| word ^ self.goal.1)
    }
}

/// The values of the input with this digit in a block of valuations.
fn pattern(digit: usize, block: u64) -> Block {
    if let Some(word) = PATTERNS.get(digit) {
        return [*word; LANES];
    }
    let first = block * LANES as u64;
    std::array::from_fn(|lane| match (first + lane as u64) >> (digit - 6) & 1 {
        1 => u64::MAX,
        _ => 0,
    })
}
