//! Cubes (conjunctions of literals) and covers (disjunctions of cubes).

/// An atom or its negation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Literal {
    /// The number of the atom.
    pub atom: usize,
    /// Whether it holds where the atom does.
    pub positive: bool,
}

/// A conjunction of literals of different atoms, by atom. Without literals it holds everywhere.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cube {
    literals: Vec<Literal>,
}

impl Cube {
    /// The conjunction.
    pub fn new(literals: impl IntoIterator<Item = Literal>) -> Self {
        let mut literals: Vec<Literal> = literals.into_iter().collect();
        literals.sort_unstable();
        literals.dedup();
        Self { literals }
    }

    /// The literals, by atom.
    pub fn literals(&self) -> &[Literal] {
        &self.literals
    }

    /// Whether it holds where the atoms have these values.
    pub fn holds(&self, mut value: impl FnMut(usize) -> bool) -> bool {
        self.literals.iter().all(|l| value(l.atom) == l.positive)
    }

    /// The cube without one of its literals.
    #[must_use]
    pub fn without(&self, literal: Literal) -> Self {
        Self {
            literals: self
                .literals
                .iter()
                .copied()
                .filter(|l| *l != literal)
                .collect(),
        }
    }
}

/// A disjunction of cubes. Without cubes it holds nowhere.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cover {
    cubes: Vec<Cube>,
}

impl Cover {
    /// The disjunction; shorter cubes stand first.
    pub fn new(cubes: impl IntoIterator<Item = Cube>) -> Self {
        let mut cubes: Vec<Cube> = cubes.into_iter().collect();
        cubes.sort_by(|a, b| (a.literals().len(), a).cmp(&(b.literals().len(), b)));
        cubes.dedup();
        Self { cubes }
    }

    /// The cubes, shorter ones first.
    pub fn cubes(&self) -> &[Cube] {
        &self.cubes
    }

    /// The number of literals in all cubes.
    pub fn literals(&self) -> usize {
        self.cubes.iter().map(|cube| cube.literals().len()).sum()
    }

    /// Whether it holds where the atoms have these values.
    pub fn holds(&self, mut value: impl FnMut(usize) -> bool) -> bool {
        self.cubes.iter().any(|cube| cube.holds(&mut value))
    }
}
