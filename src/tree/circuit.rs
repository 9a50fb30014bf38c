//! Boolean functions as one circuit of and-gates and inverters, in which equal gates are shared (Kuehlmann and Krohm,
//! "Equivalence checking using cuts and heaps", 1997).
//!
//! Two functions that come from similar trees share most of their gates, so that much of a question of equivalence is
//! answered while it is asked. What is left is answered by bit-parallel [truth tables](truth) or a [SAT solver](sat).

pub(super) mod guards;
#[cfg(test)]
mod rup;
pub(super) mod sat;
pub(super) mod truth;

use rustc_hash::{FxHashMap, FxHashSet};

/// The output of a gate, or its negation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Signal(u32);

impl Signal {
    /// Never.
    pub(super) const FALSE: Self = Self(0);
    /// Always.
    pub(super) const TRUE: Self = Self(1);

    /// The constant.
    pub(super) fn constant(value: bool) -> Self {
        Self(u32::from(value))
    }

    /// The signal, negated if `negated`.
    pub(super) fn negated_if(self, negated: bool) -> Self {
        Self(self.0 ^ u32::from(negated))
    }

    /// The number of its gate.
    fn gate(self) -> usize {
        (self.0 >> 1) as usize
    }

    /// Whether it is the negation of its gate's output.
    fn is_negated(self) -> bool {
        self.0 & 1 == 1
    }
}

impl std::ops::Not for Signal {
    type Output = Self;

    fn not(self) -> Self {
        Self(self.0 ^ 1)
    }
}

#[derive(Clone, Copy, Debug)]
enum Gate {
    /// The first gate; its output is 0.
    False,
    Input,
    And(Signal, Signal),
}

/// A circuit. Gates stand behind those that they read.
#[derive(Debug)]
pub(super) struct Circuit {
    gates: Vec<Gate>,
    /// The gate of every conjunction that was asked for.
    known: FxHashMap<(Signal, Signal), Signal>,
}

impl Circuit {
    /// A circuit without inputs.
    pub(super) fn new() -> Self {
        Self {
            gates: vec![Gate::False],
            known: FxHashMap::default(),
        }
    }

    /// One more input.
    pub(super) fn input(&mut self) -> Signal {
        self.add(Gate::Input)
    }

    fn add(&mut self, gate: Gate) -> Signal {
        // 2^31 gates would not fit in memory.
        let number = u32::try_from(self.gates.len()).unwrap_or(u32::MAX >> 1);
        self.gates.push(gate);
        Signal(number << 1)
    }

    fn gate(&self, signal: Signal) -> Gate {
        self.gates
            .get(signal.gate())
            .copied()
            .unwrap_or(Gate::False)
    }

    /// The conjunction.
    pub(super) fn and(&mut self, a: Signal, b: Signal) -> Signal {
        let (a, b) = if a <= b { (a, b) } else { (b, a) };
        if a == Signal::FALSE || a == !b {
            return Signal::FALSE;
        }
        if a == Signal::TRUE || a == b {
            return b;
        }
        if let Some(signal) = self.known.get(&(a, b)) {
            return *signal;
        }
        let signal = match self.absorbed(a, b).or_else(|| self.absorbed(b, a)) {
            Some((c, d)) if (c, d) != (a, b) && (d, c) != (a, b) => self.and(c, d),
            _ => self.add(Gate::And(a, b)),
        };
        self.known.insert((a, b), signal);
        signal
    }

    /// A simpler conjunction for that of `a` with a gate `b` that reads `a` or its negation.
    fn absorbed(&self, a: Signal, b: Signal) -> Option<(Signal, Signal)> {
        let Gate::And(c, d) = self.gate(b) else {
            return None;
        };
        let negated = b.is_negated();
        match (a, negated) {
            _ if a == c || a == d => Some(match negated {
                // a and (a and d) is (a and d); a and not (a and d) is a and not d.
                false => (b, Signal::TRUE),
                true => (a, if a == c { !d } else { !c }),
            }),
            _ if a == !c || a == !d => Some(match negated {
                false => (Signal::FALSE, Signal::FALSE),
                true => (a, Signal::TRUE),
            }),
            _ => None,
        }
    }

    /// The disjunction.
    pub(super) fn or(&mut self, a: Signal, b: Signal) -> Signal {
        !self.and(!a, !b)
    }

    /// Whether the two differ.
    pub(super) fn xor(&mut self, a: Signal, b: Signal) -> Signal {
        let (left, right) = (self.and(a, !b), self.and(!a, b));
        self.or(left, right)
    }

    /// `yes` where `test` holds, `no` elsewhere.
    pub(super) fn choose(&mut self, test: Signal, yes: Signal, no: Signal) -> Signal {
        let (yes, no) = (self.and(test, yes), self.and(!test, no));
        self.or(yes, no)
    }

    /// The conjunction of all.
    pub(super) fn all(&mut self, signals: impl IntoIterator<Item = Signal>) -> Signal {
        signals
            .into_iter()
            .fold(Signal::TRUE, |all, signal| self.and(all, signal))
    }

    /// The disjunction of all.
    pub(super) fn any(&mut self, signals: impl IntoIterator<Item = Signal>) -> Signal {
        !self.all(signals.into_iter().map(|signal| !signal))
    }

    /// Whether at least `count` of the signals hold: a sequential counter (Sinz 2005).
    pub(super) fn at_least(&mut self, count: usize, signals: &[Signal]) -> Signal {
        if count > signals.len() {
            return Signal::FALSE;
        }
        // The k-th signal: more than k of those before hold.
        let mut more = vec![Signal::FALSE; count];
        for signal in signals {
            let mut below = Signal::TRUE;
            for held in &mut more {
                let one_more = self.and(below, *signal);
                below = *held;
                *held = self.or(*held, one_more);
            }
        }
        more.last().copied().unwrap_or(Signal::TRUE)
    }

    /// The gates that the signals depend on, ascending, and so each behind those that it reads.
    fn cone(&self, signals: &[Signal]) -> Vec<usize> {
        let mut seen = vec![false; self.gates.len()];
        let mut open: Vec<usize> = signals.iter().map(|signal| signal.gate()).collect();
        let mut cone = Vec::new();
        while let Some(gate) = open.pop() {
            match seen.get_mut(gate) {
                Some(seen) if !*seen => *seen = true,
                _ => continue,
            }
            cone.push(gate);
            if let Some(Gate::And(a, b)) = self.gates.get(gate) {
                open.extend([a.gate(), b.gate()]);
            }
        }
        cone.sort_unstable();
        cone
    }

    /// Whether a signal holds where the inputs have these values; others are false.
    pub(super) fn holds(&self, signal: Signal, inputs: &[Signal], values: &[bool]) -> bool {
        let given = inputs.iter().zip(values).filter(|(_, value)| **value);
        let mut high: FxHashSet<usize> = given.map(|(input, _)| input.gate()).collect();
        let value = |high: &FxHashSet<usize>, signal: Signal| {
            high.contains(&signal.gate()) != signal.is_negated()
        };
        for gate in self.cone(&[signal]) {
            if let Some(Gate::And(a, b)) = self.gates.get(gate)
                && value(&high, *a)
                && value(&high, *b)
            {
                high.insert(gate);
            }
        }
        value(&high, signal)
    }

    /// Which of `inputs` the signals of a cone read; a constant among them is none.
    fn reads(&self, cone: &[usize], inputs: &[Signal]) -> Vec<bool> {
        let reads = |input: &Signal| {
            matches!(self.gate(*input), Gate::Input) && cone.binary_search(&input.gate()).is_ok()
        };
        inputs.iter().map(reads).collect()
    }

    /// How many of `inputs` the signal depends on.
    pub(super) fn support(&self, signal: Signal, inputs: &[Signal]) -> usize {
        let reads = self.reads(&self.cone(&[signal]), inputs);
        reads.into_iter().filter(|reads| *reads).count()
    }
}

#[cfg(test)]
mod tests {
    use super::sat::Solver;
    use super::{Circuit, Signal, truth};

    /// A circuit over `inputs` inputs with random gates, and its last signal.
    fn random(inputs: usize, seed: u64) -> (Circuit, Vec<Signal>, Signal) {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        let mut below = |n: usize| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as usize % n
        };
        let mut circuit = Circuit::new();
        let inputs: Vec<Signal> = (0..inputs).map(|_| circuit.input()).collect();
        let mut signals = inputs.clone();
        for _ in 0..30 {
            let [a, b, c] = [0; 3].map(|_| {
                let signal = signals[below(signals.len())];
                signal.negated_if(below(2) == 1)
            });
            signals.push(match below(4) {
                0 => circuit.and(a, b),
                1 => circuit.xor(a, b),
                2 => circuit.choose(a, b, c),
                _ => circuit.at_least(2, &[a, b, c]),
            });
        }
        let goal = signals.iter().rev().take(4).copied();
        let goal = circuit.all(goal.collect::<Vec<_>>());
        (circuit, inputs, goal)
    }

    #[test]
    fn table_and_solver_find_the_least_valuation_that_plain_evaluation_finds() {
        let mut found = 0;
        for seed in 1..=300 {
            let count = 1 + (seed % 11) as usize;
            let (circuit, inputs, goal) = random(count, seed);
            let values =
                |bits: u32| -> Vec<bool> { (0..count).rev().map(|i| bits >> i & 1 == 1).collect() };
            let mut valuations = (0..1 << count).map(values);
            let expected = valuations.find(|values| circuit.holds(goal, &inputs, values));
            assert_eq!(truth::least(&circuit, goal, &inputs), expected, "{seed}");
            let budget = || Solver::new(u64::MAX);
            for mut solver in [budget(), budget().deciding_inputs()] {
                let solved = solver.least(&circuit, &[goal], &inputs);
                assert_eq!(solved, Ok(expected.clone()), "{seed}");
            }
            found += usize::from(expected.is_some());
        }
        assert!((50..250).contains(&found), "{found}");
    }

    #[test]
    fn a_solver_whose_budget_is_spent_says_so() {
        let (circuit, _, goal) = random(11, 7);
        assert!(Solver::new(0).can_hold(&circuit, &[goal]).is_err());
    }
}
