//! Who invents programs: random choices, and what the program at hand has declared.

use btc::random::Random;

/// The types of what programs compute with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Type {
    Bool,
    Number,
    Ratio,
    Length,
    Time,
    Angle,
    Speed,
    Turn,
    Point,
    /// An enum.
    Enum(&'static str),
    /// The places of a kind.
    Kind(&'static str),
    /// All walls that are doors.
    Door,
    /// The other robots.
    Robot,
}

impl Type {
    /// Quantities, which have an order and can be added.
    pub(super) const QUANTITIES: [Type; 7] = [
        Type::Number,
        Type::Ratio,
        Type::Length,
        Type::Time,
        Type::Angle,
        Type::Speed,
        Type::Turn,
    ];

    /// As the language writes it.
    pub(super) fn written(&self) -> &'static str {
        match self {
            Type::Bool => "bool",
            Type::Number => "number",
            Type::Ratio => "ratio",
            Type::Length => "length",
            Type::Time => "time",
            Type::Angle => "angle",
            Type::Speed => "speed",
            Type::Turn => "turn_rate",
            Type::Point => "point",
            Type::Enum(name) | Type::Kind(name) => name,
            Type::Door => "door",
            Type::Robot => "robot",
        }
    }
}

/// A variable, a function or a family: its name, its parameters and its type.
#[derive(Clone, Debug)]
pub(super) struct Known {
    pub(super) name: String,
    pub(super) params: Vec<Type>,
    pub(super) ty: Type,
}

/// A behaviour with its arguments, and whether it may end so.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Choice {
    pub(super) call: String,
    /// What stands for it and others in `choose`.
    pub(super) family: Option<String>,
    pub(super) succeeds: bool,
    pub(super) fails: bool,
}

/// What may stand where an expression does.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Region {
    /// `uniform`, `normal`, `chance`, `one_of`.
    pub(super) draws: bool,
    /// `elapsed`.
    pub(super) elapsed: bool,
    /// What another robot reads, which can read neither the sensors of the first nor others but the first.
    pub(super) script: bool,
    /// `tune`.
    pub(super) tunes: bool,
}

/// What the program at hand has declared.
#[derive(Debug, Default)]
pub(super) struct Declared {
    /// The kinds of places with their members.
    pub(super) kinds: Vec<(&'static str, Vec<String>)>,
    /// The places, those of kinds among them.
    pub(super) places: Vec<String>,
    /// The places that face somewhere.
    pub(super) facing: Vec<String>,
    pub(super) walls: Vec<String>,
    pub(super) doors: Vec<String>,
    pub(super) robots: Vec<String>,
    /// What they do.
    pub(super) scripts: Vec<&'static str>,
    pub(super) enums: Vec<(&'static str, Vec<&'static str>)>,
    pub(super) sensors: Vec<String>,
    pub(super) holonomic: bool,
    pub(super) states: Vec<Known>,
    /// Shared expressions.
    pub(super) shared: Vec<Known>,
    /// Predicates; their type is `bool`.
    pub(super) predicates: Vec<Known>,
    pub(super) events: Vec<Known>,
    /// The behaviours to choose from.
    pub(super) choices: Vec<Choice>,
    /// Those that the tree at hand has.
    pub(super) selected: Vec<Choice>,
}

/// An author of programs.
pub(super) struct Author {
    pub(super) random: Random,
    pub(super) has: Declared,
    /// Names that are bound where the author is writing.
    pub(super) scope: Vec<Known>,
    fresh: usize,
}

impl Author {
    pub(super) fn new(seed: u64) -> Self {
        Self {
            random: Random::new(seed, 0, 0),
            has: Declared::default(),
            scope: Vec::new(),
            fresh: 0,
        }
    }

    /// A number below n.
    pub(super) fn below(&mut self, n: usize) -> usize {
        self.random.below(n as u64) as usize
    }

    /// From `low` to `high`.
    pub(super) fn count(&mut self, low: usize, high: usize) -> usize {
        low + self.below(high - low + 1)
    }

    pub(super) fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    pub(super) fn pick<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())].clone()
    }

    /// A name that nothing has.
    pub(super) fn name(&mut self, word: &str) -> String {
        self.fresh += 1;
        match self.chance(4) {
            true => format!("`{word} no. {}`", self.fresh),
            false => format!("{word}_{}", self.fresh),
        }
    }

    /// Some of these, at least one.
    pub(super) fn some<T: Clone>(&mut self, of: &[T]) -> Vec<T> {
        let kept: Vec<T> = of.iter().filter(|_| self.chance(60)).cloned().collect();
        if kept.is_empty() {
            vec![self.pick(of)]
        } else {
            kept
        }
    }

    /// The behaviours to choose from, as they are called.
    pub(super) fn calls(&self) -> Vec<String> {
        self.has
            .choices
            .iter()
            .map(|choice| choice.call.clone())
            .collect()
    }

    /// A behaviour that another robot runs, and that robot.
    pub(super) fn by_another(&mut self) -> Option<(String, String)> {
        let robots = self.has.robots.clone();
        let at = (!robots.is_empty()).then(|| self.below(robots.len()))?;
        let of: &[&str] = match self.has.scripts[at] {
            "roam" => &["wander", "wait(300 ms)"],
            "stalk" => &["wander"],
            "attend(post)" => &["goto(post)", "flee(worker)"],
            _ => &["wander"],
        };
        Some((self.pick(of).to_owned(), robots[at].clone()))
    }

    /// A type that a family may range over.
    pub(super) fn ranging(&mut self) -> Type {
        let mut types: Vec<Type> = self
            .has
            .kinds
            .iter()
            .map(|(name, _)| Type::Kind(name))
            .collect();
        types.extend(self.has.enums.iter().map(|(name, _)| Type::Enum(name)));
        if !self.has.robots.is_empty() {
            types.push(Type::Robot);
        }
        if !self.has.doors.is_empty() {
            types.push(Type::Door);
        }
        self.pick(&types)
    }

    /// The members of a type that a family may range over.
    pub(super) fn members(&self, ty: &Type) -> Vec<String> {
        match ty {
            Type::Kind(name) => {
                let of = self.has.kinds.iter().find(|(kind, _)| kind == name);
                of.unwrap().1.clone()
            }
            Type::Enum(name) => {
                let of = self.has.enums.iter().find(|(kind, _)| kind == name);
                of.unwrap().1.iter().map(|it| (*it).to_owned()).collect()
            }
            Type::Robot => self.has.robots.clone(),
            Type::Door => self.has.doors.clone(),
            other => unreachable!("{other:?}"),
        }
    }

    /// Runs a pass with names bound.
    pub(super) fn with<T>(
        &mut self,
        names: &[(String, Type)],
        pass: impl FnOnce(&mut Self) -> T,
    ) -> T {
        let depth = self.scope.len();
        self.scope.extend(names.iter().map(|(name, ty)| Known {
            name: name.clone(),
            params: Vec::new(),
            ty: ty.clone(),
        }));
        let result = pass(self);
        self.scope.truncate(depth);
        result
    }
}
