//! Answers that nothing can hold, checked without the solver: each clause that it has learned follows from those before it by
//! unit propagation (reverse unit propagation; Goldberg and Novikov, "Verification of proofs of unsatisfiability for CNF
//! formulas", 2003), and so does in the end that the assumptions contradict each other. Tests check every such answer.

use rustsat::types::Lit;
use std::collections::BTreeSet;

/// The clauses that a solver was given, with those that it has learned from them.
#[derive(Debug, Default)]
pub(super) struct Proof {
    clauses: Vec<Vec<Lit>>,
    /// Those that are not checked yet, in their order.
    learned: Vec<Vec<Lit>>,
    /// How many were checked.
    pub(super) checked: usize,
}

impl Proof {
    /// A clause that is given.
    pub(super) fn given(&mut self, clause: &[Lit]) {
        self.clauses.push(clause.to_vec());
    }

    /// A clause that is said to follow.
    pub(super) fn learned(&mut self, clause: Vec<Lit>) {
        self.learned.push(clause);
    }

    /// Checks what was learned, and that these cannot hold together.
    pub(super) fn refutes(&mut self, assumptions: &[Lit]) {
        for clause in std::mem::take(&mut self.learned) {
            let denied: Vec<Lit> = clause.iter().map(|literal| !*literal).collect();
            assert!(self.contradicts(&denied), "{clause:?} does not follow");
            self.clauses.push(clause);
            self.checked += 1;
        }
        assert!(self.contradicts(assumptions), "{assumptions:?} may hold");
    }

    /// Whether unit propagation from these meets a clause of which nothing can hold.
    fn contradicts(&self, assumed: &[Lit]) -> bool {
        let mut holds: BTreeSet<Lit> = assumed.iter().copied().collect();
        if assumed.iter().any(|literal| holds.contains(&!*literal)) {
            return true;
        }
        loop {
            let before = holds.len();
            for clause in &self.clauses {
                if clause.iter().any(|literal| holds.contains(literal)) {
                    continue;
                }
                let mut open = clause.iter().filter(|literal| !holds.contains(&!**literal));
                match (open.next(), open.next()) {
                    (None, _) => return true,
                    (Some(&unit), None) => {
                        holds.insert(unit);
                    }
                    _ => {}
                }
            }
            if holds.len() == before {
                return false;
            }
        }
    }
}

/// Of `a or b` alone, `a` does not follow.
#[test]
#[should_panic(expected = "does not follow")]
fn what_does_not_follow_is_told() {
    let mut proof = Proof::default();
    let [a, b] = [Lit::positive(0), Lit::positive(1)];
    proof.given(&[a, b]);
    proof.learned(vec![a]);
    proof.refutes(&[!a, !b]);
}

#[test]
fn what_follows_is_accepted() {
    let mut proof = Proof::default();
    let [a, b] = [Lit::positive(0), Lit::positive(1)];
    for clause in [[a, b], [a, !b], [!a, b], [!a, !b]] {
        proof.given(&clause);
    }
    proof.learned(vec![a]);
    proof.refutes(&[]);
    assert_eq!(proof.checked, 1);
}
