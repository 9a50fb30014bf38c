//! Why conditions hold never or always: of all that follows from the values of one state the first is told, and shows the rest.

use crate::check::Checker;
use crate::ir::expr::{Expr, ExprId};
use crate::ir::program::{State, Stays, ValueKind};
use crate::ir::tree::{Atom, Guard};
use crate::ir::{Id, Name, Program};
use crate::source::Span;
use std::collections::{BTreeMap, BTreeSet};

/// How many states are looked at for a cause.
const MOST: usize = 64;

/// How many places a warning shows beside its own.
const SHOWN: usize = 3;

/// What a state, one of a family, or a local would have to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Lacks {
    /// Less than it ever is.
    Less,
    /// Greater than it ever is.
    Greater,
    /// This value.
    Value(u32),
}

impl Lacks {
    /// What a variable lacks that has these values, which are `count` where they are not numbers.
    pub fn of(stays: &Stays, count: usize) -> Vec<Self> {
        match stays {
            Stays::Within(ends) => {
                let less = ends.start().is_finite().then_some(Self::Less);
                let greater = ends.end().is_finite().then_some(Self::Greater);
                less.into_iter().chain(greater).collect()
            }
            Stays::Among(among) => {
                let values = 0..count.min(u64::BITS as usize) as u32;
                let lacking = values.filter(|value| among & 1 << value == 0);
                lacking.map(Self::Value).collect()
            }
        }
    }

    /// These values with what lacks.
    pub fn free(self, stays: &Stays) -> Stays {
        match (self, stays) {
            (Self::Less, stays) => stays.endless(true, false),
            (Self::Greater, stays) => stays.endless(false, true),
            (Self::Value(value), Stays::Among(among)) => Stays::Among(among | 1 << value),
            (Self::Value(_), Stays::Within(_)) => Stays::ANY,
        }
    }

    /// That nothing makes a variable so, which has these values, and is `first` as it is declared; `variants` are those of its enum.
    pub fn in_words(
        self,
        name: &str,
        stays: &Stays,
        first: Option<f64>,
        variants: &[Name],
    ) -> String {
        let is_first = match (stays, self) {
            (Stays::Within(ends), Self::Less) => first == Some(*ends.start()),
            (Stays::Within(ends), Self::Greater) => first == Some(*ends.end()),
            _ => false,
        };
        match self {
            Self::Less if is_first => {
                format!("in an episode nothing makes `{name}` less than it is declared")
            }
            Self::Less => format!("in an episode nothing that sets `{name}` makes it small enough"),
            Self::Greater if is_first => {
                format!("in an episode nothing makes `{name}` greater than it is declared")
            }
            Self::Greater => {
                format!("in an episode nothing that sets `{name}` makes it great enough")
            }
            Self::Value(value) => match variants.get(value as usize) {
                Some(variant) => format!("nothing sets `{name}` to `{variant}`"),
                None => format!("nothing sets `{name}` to `{}`", value == 1),
            },
        }
    }
}

/// A value that a state never has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cause {
    /// The first of its family.
    state: Id<State>,
    lacks: Lacks,
}

/// The causes that have been told, each with the place of its warning, and how many places that shows.
pub type Causes = BTreeMap<Cause, (usize, usize)>;

impl Checker<'_> {
    /// The value that a state lacks, if what `rests` says of conditions would not be so with that value.
    pub fn cause(&mut self, asked: &[ExprId], rests: &dyn Fn(&Program) -> bool) -> Option<Cause> {
        for family in self.families_of(asked) {
            let first = *family.first()?;
            for lacks in self.lacking(first) {
                let kept: Vec<Stays> = family.iter().map(|id| self.free(*id, lacks)).collect();
                let rested = rests(&self.program);
                for (id, stays) in family.iter().zip(kept) {
                    self.program.states[*id].stays = stays;
                }
                if !rested {
                    return Some(Cause {
                        state: first,
                        lacks,
                    });
                }
            }
        }
        None
    }

    /// Whether a warning of this cause has been told; it then shows this place, too, which `says` something such as "never holds".
    pub fn has_told(&mut self, cause: Option<Cause>, at: Span, says: &str) -> bool {
        let Some((told, shown)) = cause.and_then(|cause| self.causes.get_mut(&cause)) else {
            return false;
        };
        *shown += 1;
        if *shown <= SHOWN
            && let Some(told) = self.diagnostics.get_mut(*told)
        {
            let label = format!("this {says}, for the same reason");
            *told = told.clone().also(at, label);
        }
        true
    }

    /// Notes that the warning that was told last has this cause, and says it.
    pub fn tells(&mut self, cause: Option<Cause>) {
        let (Some(cause), Some(last)) = (cause, self.diagnostics.len().checked_sub(1)) else {
            return;
        };
        let state = &self.program.states[cause.state];
        let name = &state.name.family;
        let variants = match &state.kind {
            ValueKind::Enum(variants) => variants.as_slice(),
            ValueKind::Bool | ValueKind::Quantity => &[],
        };
        let first = self.program.pool.constant(state.initial);
        let note = cause.lacks.in_words(name, &state.stays, first, variants);
        if let Some(told) = self.diagnostics.get_mut(last) {
            *told = told.clone().note(note);
        }
        self.causes.insert(cause, (last, 0));
    }

    /// The values that a state never has, as far as they may make a difference.
    fn lacking(&self, state: Id<State>) -> Vec<Lacks> {
        let State { kind, stays, .. } = &self.program.states[state];
        let count = match kind {
            ValueKind::Enum(variants) => variants.len(),
            _ => 2,
        };
        Lacks::of(stays, count)
    }

    /// Lets a state have what it lacks; gives what it had.
    fn free(&mut self, state: Id<State>, lacks: Lacks) -> Stays {
        let stays = &mut self.program.states[state].stays;
        let freed = lacks.free(stays);
        std::mem::replace(stays, freed)
    }

    /// The families of states that conditions ask, those of events among them.
    fn families_of(&self, asked: &[ExprId]) -> Vec<Vec<Id<State>>> {
        let mut seen = BTreeSet::new();
        let mut open = asked.to_vec();
        let mut states = BTreeSet::new();
        while let Some(id) = open.pop() {
            if !seen.insert(id) {
                continue;
            }
            open.extend(self.program.pool.operands(id));
            match self.program.pool.get(id) {
                Expr::State(state) => {
                    states.insert(state);
                }
                Expr::Event(event) => open.push(self.program.events[event].when),
                _ => {}
            }
        }
        let mut families: BTreeMap<&str, Vec<Id<State>>> = BTreeMap::new();
        for id in states.into_iter().take(MOST) {
            let family = &self.program.states[id].name.family;
            families.entry(family).or_insert_with(|| self.family(id));
        }
        families.into_values().collect()
    }

    /// The states of the family of this one, which are declared in one place.
    fn family(&self, id: Id<State>) -> Vec<Id<State>> {
        let states = &self.program.states;
        let own = |at: &usize| {
            *at < states.len() && states[Id::new(*at)].name.family == states[id].name.family
        };
        let first = (0..id.index()).rev().take_while(own).last();
        let all = (first.unwrap_or(id.index())..).take_while(own);
        all.map(Id::new).collect()
    }

    /// What the predicates of a guard ask.
    pub fn asked_by(&self, guard: &Guard) -> Vec<ExprId> {
        let mut asked = Vec::new();
        guard.visit_atoms(&mut |atom| {
            if let Atom::Predicate(id) = atom {
                asked.extend(self.program.predicates[id].when);
            }
        });
        asked
    }
}
