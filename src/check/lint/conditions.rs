//! Conditions of events, effects, doors and prices that always or never hold.

use super::apart::because;
use super::cases::of_expr;
use super::tree::at_success;
use crate::check::Checker;
use crate::check::context::Region;
use crate::diagnostic::Code;
use crate::ir::expr::{Expr, ExprId};
use crate::source::{FileId, Span};
use crate::syntax::ast::{self, ExprKind};
use std::collections::BTreeMap;

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
    /// Whether `and` or `or` joins it with another one.
    joined: bool,
}

/// Places in the text, joined where they overlap: by file and start, the end.
#[derive(Default)]
struct Places(BTreeMap<(FileId, u32), u32>);

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

    fn overlap(&self, at: Span) -> bool {
        self.last(at).is_some()
    }

    fn add(&mut self, mut at: Span) {
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

    /// Notes the condition of a choice between values, if it is written without any name.
    pub fn chooses_by(&mut self, written: &'a ast::Expr, condition: Option<ExprId>) {
        if is_nameless(written)
            && let Some(noted) = self.notes(written.span, condition)
        {
            noted.nameless = true;
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
        });
        self.conditions.last_mut()
    }

    /// Warns of the conditions that always or never hold. Of what stands in the text once for each member of a kind, all
    /// have to; what has the name of a constant is meant to be one.
    pub fn conditions_without_effect(&mut self) {
        let noted = std::mem::take(&mut self.conditions);
        let (sides, whole) = noted.into_iter().partition(|it| it.joined);
        self.conditions = sides;
        self.hold_always_or_never(whole);
    }

    /// Warns of the sides of `and` and `or` that always or never hold, where the whole does not: of the innermost.
    pub fn sides_without_effect(&mut self) {
        let mut told = Places::default();
        let known = self.diagnostics.iter();
        let known = known.filter(|found| found.code == Code::W0601);
        known.for_each(|found| told.add(found.span()));
        let mut sides = std::mem::take(&mut self.conditions);
        sides.sort_by_key(|side| side.at.end - side.at.start);
        for side in sides {
            let (at, before) = (side.at, self.diagnostics.len());
            if !told.overlap(at) {
                self.hold_always_or_never(vec![side]);
            }
            if self.diagnostics.len() > before {
                told.add(at);
            }
        }
    }

    fn hold_always_or_never(&mut self, noted: Vec<Condition>) {
        let world = self.program.world.as_ref();
        let alone = world.is_none_or(|world| world.others.is_empty());
        let mut places: BTreeMap<Span, Vec<Condition>> = BTreeMap::new();
        for condition in noted {
            places.entry(condition.at).or_default().push(condition);
        }
        for (at, conditions) in places {
            let pool = &self.program.pool;
            let told = |it: &Condition| {
                // Of an event that never happens it is told where that is declared.
                pool.constant(it.asks).is_some() && !it.nameless
                    || matches!(pool.get(it.asks), Expr::Event(_))
                    || it.of_any_robot && !it.nameless && !alone
            };
            if conditions.iter().any(told) || self.says_one_thing_twice(at) {
                continue;
            }
            let never = |wanted| {
                let mut all = conditions.iter();
                all.all(|it| {
                    let cases = of_expr(&self.program, it.asks, wanted);
                    match wanted {
                        true => cases.and(&at_success(&self.program, it.asks)).is_never(),
                        false => cases.is_never(),
                    }
                })
            };
            let says = match (never(true), never(false)) {
                (true, _) => "never",
                (_, true) => "always",
                _ => continue,
            };
            let why = conditions
                .first()
                .and_then(|it| because(&self.program, it.asks));
            self.warning(Code::W0601, at, format!("this condition {says} holds"))
                .label("whatever happens in the world")
                .note_if(why);
        }
    }
}

/// Whether an expression is written without any name.
fn is_nameless(expr: &ast::Expr) -> bool {
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
