//! Bounds on the wrong side: `min` where a value falls, and `max` where it rises.

use super::ranges::range;
use super::stays::{Set, begins};
use super::view::View;
use crate::check::Checker;
use crate::diagnostic::{Applicability, Code};
use crate::ir::expr::{Binary, Expr, ExprId};
use crate::ir::program::{State, Stays};
use crate::ir::{Id, Pool};
use crate::source::Span;
use crate::syntax::ast::{self, Block, Else, ExprKind, Item, ItemKind, StmtKind};
use std::collections::{BTreeMap, BTreeSet};

/// The values, bounded from one side, that statements set states to, by where the statements stand.
pub type Bounded = BTreeMap<Span, Vec<(Id<State>, ExprId)>>;

/// A bound on the wrong side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Wrong {
    side: Side,
    /// Whether the value never is where the bound would hold it.
    idle: bool,
}

/// A bound from one side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    /// `min(…, bound)`
    Most,
    /// `max(…, bound)`
    Least,
}

impl<'a> Checker<'a> {
    /// Notes a value that a statement sets a state to, if it is bounded from one side.
    pub fn notes_bound(&mut self, at: Span, state: Id<State>, value: ExprId) {
        let bounds = [Binary::Min, Binary::Max];
        if matches!(self.program.pool.get(value), Expr::Binary(op, ..) if bounds.contains(&op)) {
            self.bounded.entry(at).or_default().push((state, value));
        }
    }

    /// Warns of states that fall and are bounded from above, or rise and are bounded from below, where that takes them past the bound
    /// at once: in every tick where they begin beyond it, and wherever something happens where it is what they begin with. And
    /// in every tick where they never get to the bound.
    pub fn bounds_on_the_wrong_side(&mut self, items: impl Iterator<Item = &'a Item>) {
        let bounded = std::mem::take(&mut self.bounded);
        if bounded.is_empty() || self.values_are_unsure() {
            return;
        }
        let begins = begins(&self.program);
        let mut told = BTreeSet::new();
        for item in items {
            let (block, in_ticks) = match &item.kind {
                ItemKind::EachTick(block) => (block, true),
                ItemKind::On(on) => (&on.block, false),
                _ => continue,
            };
            for (at, value, decided) in calls(block) {
                let Some(noted) = bounded.get(&at).filter(|_| told.insert(at)) else {
                    continue;
                };
                let mut sides = noted
                    .iter()
                    .map(|it| self.wrong_side(*it, &begins, [in_ticks, decided]));
                let first = sides.next().flatten();
                if let Some(wrong) = first.filter(|_| sides.all(|side| side == first)) {
                    self.bounded_on_the_wrong(wrong, noted.first(), value);
                }
            }
        }
    }

    fn bounded_on_the_wrong(
        &mut self,
        wrong: Wrong,
        noted: Option<&(Id<State>, ExprId)>,
        call: &ast::Ref,
    ) {
        let Some((state, _)) = noted else { return };
        let name = self.program.states[*state].name.family.clone();
        let (message, label, right) = match wrong.side {
            Side::Most => (
                format!("`{name}` falls, and `min` bounds it from above"),
                "so it jumps down to its bound, and falls on",
                "max",
            ),
            Side::Least => (
                format!("`{name}` rises, and `max` bounds it from below"),
                "so it jumps up to its bound, and rises on",
                "min",
            ),
        };
        let word = call.name.span;
        if wrong.idle {
            let help = match wrong.side {
                Side::Most => "let it rise, or bound it from below by `max`",
                Side::Least => "let it fall, or bound it from above by `min`",
            };
            self.warning(Code::W0311, word, message)
                .label("it never gets to this bound, which changes nothing")
                .help(help);
            return;
        }
        self.warning(Code::W0311, word, message).label(label).fix(
            format!("`{right}` stops it there"),
            word,
            right,
            Applicability::Unsafe,
        );
    }

    /// The side from which a value is bounded that a state is set to, if it is the wrong one.
    fn wrong_side(
        &self,
        (state, value): (Id<State>, ExprId),
        begins: &Set,
        [in_ticks, decided]: [bool; 2],
    ) -> Option<Wrong> {
        let pool = &self.program.pool;
        let Expr::Binary(op, a, b) = pool.get(value) else {
            return None;
        };
        let (moved, bound) = match (pool.constant(a), pool.constant(b)) {
            (None, Some(bound)) => (a, bound),
            (Some(bound), None) => (b, bound),
            _ => return None,
        };
        let initial = self.program.states[state].initial;
        let first = begins.get(&state).map_or(&[][..], Vec::as_slice);
        let Stays::Within(first) = self.one_of_these(state, first) else {
            return None;
        };
        let (low, high) = change(pool, moved, state)
            .map(|(sign, amount)| {
                let (low, high) = range(View::from(&self.program), amount).ends();
                if sign { (low, high) } else { (-high, -low) }
            })
            .filter(|(low, high)| low < high || *low != 0.0)?;
        let Stays::Within(all) = &self.program.states[state].stays else {
            return None;
        };
        // What begins with nothing and falls is less than nothing in the next tick.
        let nothing = bound == 0.0;
        let (side, beyond, idle) = match op {
            Binary::Min if high <= 0.0 => (
                Side::Most,
                *first.start() > bound || nothing && *first.start() == bound,
                *all.end() <= bound,
            ),
            Binary::Max if low >= 0.0 => (
                Side::Least,
                *first.end() < bound || nothing && *first.end() == bound,
                *all.start() >= bound,
            ),
            _ => return None,
        };
        // Where it happens now and then, it may be meant to jump to another value than the first.
        let from_there = bound != 0.0
            && pool.constant(initial) == Some(bound)
            && match side {
                Side::Most => *first.start() >= bound,
                Side::Least => *first.end() <= bound,
            };
        let idle = in_ticks && idle;
        let wrong = match in_ticks && !decided {
            true => beyond || idle,
            false => from_there || idle,
        };
        wrong.then_some(Wrong { side, idle })
    }
}

/// What a value adds to a state, `true`, or takes from it.
fn change(pool: &Pool, moved: ExprId, state: Id<State>) -> Option<(bool, ExprId)> {
    let is_state = |id| pool.get(id) == Expr::State(state);
    match pool.get(moved) {
        Expr::Binary(Binary::Add, a, b) if is_state(a) => Some((true, b)),
        Expr::Binary(Binary::Add, a, b) if is_state(b) => Some((true, a)),
        Expr::Binary(Binary::Sub, a, b) if is_state(a) => Some((false, b)),
        _ => None,
    }
}

/// The statements of a block that set something to what a function gives, those in its inner blocks among them: where they stand,
/// the calls, and whether a condition decides on them.
fn calls(block: &Block) -> Vec<(Span, &ast::Ref, bool)> {
    let mut found = Vec::new();
    let mut open = vec![(block, false)];
    while let Some((block, decided)) = open.pop() {
        for stmt in &block.stmts {
            match &stmt.kind {
                StmtKind::For { block, .. } => open.push((block, decided)),
                StmtKind::Branch(branch) => {
                    let mut next = Some(branch);
                    while let Some(branch) = next {
                        open.push((&branch.then, true));
                        next = match branch.otherwise.as_deref() {
                            Some(Else::If(branch)) => Some(branch),
                            Some(Else::Block(block)) => {
                                open.push((block, true));
                                None
                            }
                            None => None,
                        };
                    }
                }
                StmtKind::Assign { value, .. } => {
                    if let ExprKind::Ref(call) = &value.kind {
                        found.push((stmt.span, call, decided));
                    }
                }
                _ => {}
            }
        }
    }
    found
}
