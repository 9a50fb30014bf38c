//! Conditions of events, effects, doors and prices that always or never hold.

use super::apart::because;
use super::cases::of_expr;
use super::tree::at_success;
use super::view::is_of_a_robot;
use crate::check::Checker;
use crate::check::context::Region;
use crate::diagnostic::Code;
use crate::ir::expr::{Binary, Expr, ExprId, Unary};
use crate::ir::{Pool, Program};
use crate::source::{FileId, Span};
use crate::syntax::ast::{self, ExprKind};
use std::collections::{BTreeMap, BTreeSet};

/// A condition that stands in the text.
#[derive(Clone, Copy, Debug)]
pub struct Condition {
    /// Where it stands.
    at: Span,
    /// What it asks.
    asks: ExprId,
    /// Whether it is written without any name.
    nameless: bool,
    /// Whether any robot may ask it.
    of_any_robot: bool,
    /// Whether it is a part of another one, or of a value.
    joined: bool,
    /// Whether it is a part of `requires`, `succeed when` or `fail when`.
    of_a_clause: bool,
}

/// Places in the text, joined where they overlap: by file and start, the end.
#[derive(Default)]
pub struct Places(BTreeMap<(FileId, u32), u32>);

impl Places {
    /// The last place that begins before the end of this one, if they overlap.
    fn last(&self, at: Span) -> Option<Span> {
        let mut before = self.0.range(..(at.file, at.end));
        let ((file, start), end) = before.next_back()?;
        let last = Span {
            file: *file,
            start: *start,
            end: *end,
        };
        (last.file == at.file && last.end > at.start).then_some(last)
    }

    /// Whether this one overlaps with any.
    pub fn overlap(&self, at: Span) -> bool {
        self.last(at).is_some()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds one.
    pub fn add(&mut self, mut at: Span) {
        while let Some(last) = self.last(at) {
            self.0.remove(&(last.file, last.start));
            at.start = at.start.min(last.start);
            at.end = at.end.max(last.end);
        }
        self.0.insert((at.file, at.start), at.end);
    }
}

impl<'a> Checker<'a> {
    /// Notes a condition, to be looked at once the program is whole.
    pub fn asks(&mut self, at: Span, condition: Option<ExprId>) {
        self.notes(at, condition);
    }

    /// Notes a side of `and` or `or` in a predicate, an event or a clause. Of one that depends on parameters, nothing is
    /// said.
    pub fn joins(&mut self, written: &'a ast::Expr, side: Option<ExprId>) {
        let region = self.context.region;
        let asks = matches!(region, Region::Predicate | Region::Event | Region::Clause);
        if asks
            && self.bodies.for_itself()
            && let Some(noted) = self.notes(written.span, side)
        {
            noted.of_any_robot = region != Region::Event;
            noted.joined = true;
            noted.of_a_clause = region == Region::Clause;
        }
    }

    /// Notes what `count` or `nearest` asks of each member.
    pub fn picks_by(&mut self, written: &'a ast::Expr, says: &[ExprId]) {
        let of_any_robot = self.context.region != Region::Event;
        for asked in says {
            if let Some(noted) = self.notes(written.span, Some(*asked)) {
                noted.of_any_robot = of_any_robot;
                noted.joined = true;
            }
        }
    }

    /// Notes the condition of a branch in an effect or a control law. Of one that depends on parameters, nothing is said.
    pub fn branches_on(&mut self, written: &'a ast::Expr, condition: Option<ExprId>) {
        let of_a_law = self.context.region == Region::Control;
        let is_effect = matches!(self.context.region, Region::Effect | Region::EachTick);
        if (is_effect || of_a_law && self.bodies.for_itself())
            && let Some(noted) = self.notes(written.span, condition)
        {
            noted.nameless = is_nameless(written);
            noted.of_any_robot = of_a_law;
        }
    }

    /// Notes the condition of a choice between values. Of one that depends on parameters, nothing is said.
    pub fn chooses_by(&mut self, written: &'a ast::Expr, condition: Option<ExprId>) {
        let is_effect = matches!(self.context.region, Region::Effect | Region::EachTick);
        let nameless = is_nameless(written);
        if (nameless || is_effect || self.bodies.for_itself())
            && let Some(noted) = self.notes(written.span, condition)
        {
            noted.nameless = nameless;
            noted.of_any_robot = !is_effect;
        }
    }

    /// Notes a chance that is written as a number and leaves nothing to chance.
    pub fn draws_always(&mut self, written: &'a ast::Expr, chance: Option<ExprId>) {
        let constant = chance.and_then(|id| self.program.pool.constant(id));
        if let (true, Some(chance @ (0.0 | 1.0))) = (is_nameless(written), constant) {
            let holds = self.program.pool.bool(chance == 1.0);
            if let Some(noted) = self.notes(written.span, Some(holds)) {
                noted.nameless = true;
            }
        }
    }

    fn notes(&mut self, at: Span, asks: Option<ExprId>) -> Option<&mut Condition> {
        if self.context.library {
            return None;
        }
        self.conditions.push(Condition {
            at,
            asks: asks?,
            nameless: false,
            of_any_robot: false,
            joined: false,
            of_a_clause: false,
        });
        self.conditions.last_mut()
    }

    /// Warns of the conditions that always or never hold. Of what stands in the text once for each member of a kind, all
    /// have to; what has the name of a constant is meant to be one.
    pub fn conditions_without_effect(&mut self) {
        let noted = std::mem::take(&mut self.conditions);
        let (sides, whole) = noted.into_iter().partition(|it| it.joined);
        self.conditions = sides;
        let constant = self.constant_predicates();
        self.hold_always_or_never(whole, &constant);
    }

    /// Warns of those of these conditions that always or never hold, and notes them no longer; whether there are any.
    pub fn conditions_of(&mut self, asked: &BTreeSet<ExprId>) -> bool {
        let noted = std::mem::take(&mut self.conditions);
        let (these, others) = noted
            .into_iter()
            .partition(|it| !it.joined && asked.contains(&it.asks));
        self.conditions = others;
        let before = self.diagnostics.len();
        self.hold_always_or_never(these, &BTreeSet::new());
        self.diagnostics.len() > before
    }

    /// Warns of the sides of `and` and `or` in the clauses of behaviours that always or never hold.
    pub fn sides_of_clauses(&mut self) {
        let noted = std::mem::take(&mut self.conditions);
        let (of_clauses, others) = noted.into_iter().partition(|it| it.of_a_clause);
        self.conditions = of_clauses;
        self.sides_without_effect();
        self.conditions = others;
    }

    /// Warns of the sides of `and` and `or` that always or never hold, where the whole does not: of the innermost.
    pub fn sides_without_effect(&mut self) {
        let mut told = Places::default();
        let known = self.diagnostics.iter();
        let known = known.filter(|found| found.code == Code::W0601);
        known.for_each(|found| told.add(found.span()));
        let constant = self.constant_predicates();
        // One in a text for each member of a kind is one side for each.
        let mut sides = by_place(std::mem::take(&mut self.conditions));
        sides.sort_by_key(|(at, _)| at.end - at.start);
        for (at, side) in sides {
            let before = self.diagnostics.len();
            if !told.overlap(at) {
                self.hold_always_or_never(side, &constant);
            }
            if self.diagnostics.len() > before {
                told.add(at);
            }
        }
    }

    fn hold_always_or_never(&mut self, noted: Vec<Condition>, constant: &BTreeSet<ExprId>) {
        let alone = self.has_one_robot();
        for (at, conditions) in by_place(noted) {
            let pool = &self.program.pool;
            let told = |it: &Condition| {
                // Of an event that never happens it is told where that is declared.
                pool.constant(it.asks).is_some() && !it.nameless
                    || matches!(pool.get(it.asks), Expr::Event(_))
                    || it.of_any_robot && !it.nameless && !alone && is_of_a_robot(pool, it.asks)
                    || parts(pool, it.asks).any(|part| constant.contains(&part))
            };
            if conditions.iter().any(told) || self.says_one_thing_twice(at) {
                continue;
            }
            let never = |program: &Program, wanted| {
                let mut all = conditions.iter();
                all.all(|it| {
                    let cases = of_expr(program, it.asks, wanted);
                    match wanted {
                        true => cases.and(&at_success(program, it.asks)).is_never(),
                        false => cases.is_never(),
                    }
                })
            };
            let (says, wanted) = match [true, false].map(|wanted| never(&self.program, wanted)) {
                [true, _] => ("never", true),
                [_, true] => ("always", false),
                _ => continue,
            };
            let asked: Vec<ExprId> = conditions.iter().map(|it| it.asks).collect();
            let cause = self.cause(&asked, &|program| never(program, wanted));
            if self.has_told(cause, at, &format!("{says} holds")) {
                continue;
            }
            let why = conditions
                .first()
                .and_then(|it| because(&self.program, it.asks));
            self.warning(Code::W0601, at, format!("this condition {says} holds"))
                .label("whatever happens in the world")
                .note_if(why);
            self.tells(cause);
        }
    }
}

/// Conditions by where they stand.
fn by_place(noted: Vec<Condition>) -> Vec<(Span, Vec<Condition>)> {
    let mut places: BTreeMap<Span, Vec<Condition>> = BTreeMap::new();
    for condition in noted {
        places.entry(condition.at).or_default().push(condition);
    }
    places.into_iter().collect()
}

/// A condition and what `not`, `and` and `or` join in it.
fn parts(pool: &Pool, id: ExprId) -> impl Iterator<Item = ExprId> {
    let mut seen = BTreeSet::new();
    let mut open = vec![id];
    std::iter::from_fn(move || {
        let id = open.pop()?;
        match pool.get(id) {
            Expr::Unary(Unary::Not, of) => open.extend(Some(of).filter(|of| seen.insert(*of))),
            Expr::Binary(Binary::And | Binary::Or, a, b) => {
                open.extend([a, b].into_iter().filter(|of| seen.insert(*of)));
            }
            _ => {}
        }
        Some(id)
    })
}

/// Whether an expression is written without any name.
pub fn is_nameless(expr: &ast::Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Bool(_) => true,
        ExprKind::Paren(inner) | ExprKind::Unary { operand: inner, .. } => is_nameless(inner),
        ExprKind::Binary { left, right, .. } => is_nameless(left) && is_nameless(right),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::Places;
    use crate::source::{FileId, Span};

    /// Joined places overlap with just what one of them does.
    #[test]
    fn places_overlap_as_one_by_one() {
        let spans: Vec<Span> = (0_usize..6)
            .flat_map(|start| (start + 1..7).map(move |end| Span::new(FileId(0), start, end)))
            .collect();
        let mut found = 0;
        for (a, b) in (0..spans.len()).flat_map(|a| (0..spans.len()).map(move |b| (a, b))) {
            let told = [spans[a], spans[b], spans[(a + 2 * b) % spans.len()]];
            let mut places = Places::default();
            told.into_iter().for_each(|span| places.add(span));
            for at in &spans {
                let one = |told: &Span| told.start < at.end && at.start < told.end;
                assert_eq!(places.overlap(*at), told.iter().any(one), "{told:?} {at:?}");
                found += usize::from(places.overlap(*at));
            }
            assert!(!places.overlap(Span::new(FileId(1), 0, 7)));
        }
        assert!(found > 0);
    }
}
