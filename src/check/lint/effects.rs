//! Effects that change nothing: a value that is there already, and an amount of nothing.

use super::cases::{About, Cases, Says, of_expr};
use super::stays::{Set, of_block, set_in_ticks};
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::{Expr, ExprId};
use crate::ir::law::Block;
use crate::ir::program::State;
use crate::ir::world::World;
use crate::ir::{Id, Program};
use crate::source::Span;
use crate::syntax::ast::{AssignOp, Stmt};
use std::collections::{BTreeMap, BTreeSet};

/// A state that an effect sets, whatever else holds where it is done.
#[derive(Clone, Copy, Debug)]
pub struct Assigned {
    /// Where it stands.
    at: Span,
    /// The place of the effect among those of the program.
    effect: usize,
    state: Id<State>,
    value: ExprId,
}

/// The effects that set each state, by their places, each with the value.
type Setters = BTreeMap<Id<State>, Vec<(usize, ExprId)>>;

/// The values that statements set states to, with where they stand.
pub type Assignments = Vec<(Span, Id<State>, ExprId)>;

impl<'a> Checker<'a> {
    /// Notes a statement that sets a state.
    pub fn assigns(&mut self, at: Span, state: Id<State>, value: ExprId) {
        if !self.context.library {
            self.assignments.push((at, state, value));
            self.notes_bound(at, state, value);
        }
    }

    /// Notes what these statements set, which are those of the next effect of the program.
    pub fn done_by_effect(&mut self, statements: &[Stmt]) {
        let effect = self.program.effects.len();
        let statements: BTreeSet<Span> = statements.iter().map(|it| it.span).collect();
        let noted = std::mem::take(&mut self.assignments).into_iter();
        let outermost = noted.filter(|(at, ..)| statements.contains(at));
        self.assigned
            .extend(outermost.map(|(at, state, value)| Assigned {
                at,
                effect,
                state,
                value,
            }));
    }

    /// Notes an amount that is written as a number and changes nothing: 0 more. Once as much may say that nothing is to change.
    pub fn changes_by(&mut self, at: Span, op: AssignOp, amounts: &[ExprId]) {
        let mut amounts = amounts.iter().map(|id| self.program.pool.constant(*id));
        let adds = matches!(op, AssignOp::Add | AssignOp::Sub);
        if adds && !self.context.library && amounts.all(|amount| amount == Some(0.0)) {
            self.idle.insert(at);
        }
    }

    /// Warns of effects that set a state to what it is wherever they are done, and of amounts that change nothing.
    pub fn effects_without_effect(&mut self) {
        for at in std::mem::take(&mut self.idle) {
            self.warning(Code::W0308, at, "this changes nothing")
                .label("the value stays as it was");
        }
        let mut places: BTreeMap<Span, Vec<Assigned>> = BTreeMap::new();
        for assigned in std::mem::take(&mut self.assigned) {
            places.entry(assigned.at).or_default().push(assigned);
        }
        let set = set_in_ticks(&self.program);
        let mut setters = Setters::new();
        for (at, effect) in self.program.effects.iter().enumerate() {
            for (state, values) in of(&effect.block) {
                let values = values.into_iter().map(|(_, value)| (at, value));
                setters.entry(state).or_default().extend(values);
            }
        }
        for (at, assigned) in places {
            if assigned
                .iter()
                .all(|it| self.is_so_already(it, &set, &setters))
            {
                let Some(first) = assigned.first() else {
                    continue;
                };
                let name = self.program.states[first.state].name.family.clone();
                let message = format!("`{name}` is this already where this happens");
                self.warning(Code::W0308, at, message)
                    .label("so this changes nothing");
            }
        }
    }

    /// Whether a state has a value already wherever an effect sets it to that: what the effect waits for says so, and nothing
    /// that is done before in the same tick sets it to another one. `set` is what is set in every tick.
    fn is_so_already(&self, assigned: &Assigned, set: &Set, setters: &Setters) -> bool {
        let Assigned {
            effect,
            state,
            value,
            ..
        } = *assigned;
        let program = &self.program;
        let Some(own) = program.effects.get(effect) else {
            return false;
        };
        let all = setters.get(&state).map_or(&[][..], Vec::as_slice);
        let others = all.iter().take_while(|(at, _)| *at < effect);
        let others = others.filter(|(_, other)| *other != value);
        let mut before = others.filter_map(|(at, _)| program.effects.get(*at));
        let own_cases = of_expr(program, own.on, true);
        let happens_with =
            |other: ExprId| !own_cases.and(&of_expr(program, other, true)).is_never();
        let once = all.iter().filter(|(at, _)| *at == effect).count() == 1;
        once && !own_cases.is_never()
            && !set.contains_key(&state)
            && has(program, &own_cases, state, value)
            && !before.any(|other| happens_with(other.on))
    }
}

/// What a block sets.
fn of(block: &Block) -> Set {
    let mut set = Set::new();
    of_block(block, World::acting(), &mut set);
    set
}

/// Whether a state has a constant value in each of these cases.
fn has(program: &Program, cases: &Cases, state: Id<State>, value: ExprId) -> bool {
    let pool = &program.pool;
    let Some(value) = pool.constant(value) else {
        return false;
    };
    cases.all(|case| {
        case.iter().any(|(about, says)| match (about, says) {
            (About::Truth(id), Says::Is(is)) => {
                pool.get(*id) == Expr::State(state) && f64::from(*is) == value
            }
            (About::Number(id), says) if pool.get(*id) == Expr::State(state) => match says {
                Says::Among(among) => {
                    let one = among.count_ones() == 1;
                    one && f64::from(among.trailing_zeros()) == value
                }
                Says::Within(within) => within.ends() == (value, value),
                _ => false,
            },
            _ => false,
        })
    })
}
