//! Branches of `if … else if …` that an earlier one leaves nothing.

use super::cases::{Cases, of_expr};
use super::view::is_of_a_robot;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::ExprId;
use crate::source::Span;
use crate::syntax::ast;
use std::collections::BTreeMap;

/// The condition of an `else if`, or the `else` at the end.
#[derive(Clone, Debug)]
pub struct Link {
    /// What it asks; nothing at the end.
    asks: Option<ExprId>,
    /// What the branches before it ask.
    before: Vec<ExprId>,
    /// Whether any robot may ask it.
    of_any_robot: bool,
}

/// The conditions of an `else if`, by where each stands: several, where a text stands for several members.
pub type Links = BTreeMap<Span, (Span, Vec<Link>)>;

/// How many branches before one are looked at.
const MOST: usize = 16;

impl<'a> Checker<'a> {
    /// Notes a condition of a chain of branches, and adds it to those before the next one.
    pub fn links(
        &mut self,
        written: &'a ast::Expr,
        asks: Option<ExprId>,
        before: &mut Vec<(Span, ExprId)>,
    ) {
        let Some(asks) = asks.filter(|_| !self.context.library && before.len() < MOST) else {
            return;
        };
        self.link(written.span, Some(asks), before);
        before.push((written.span, asks));
    }

    /// Notes the last branch of a chain, for which nothing is asked. One that follows a single condition says itself what
    /// that leaves.
    pub fn ends_chain(&mut self, last: Span, before: &[(Span, ExprId)]) {
        if before.len() > 1 && before.len() < MOST {
            self.link(last, None, before);
        }
    }

    fn link(&mut self, at: Span, asks: Option<ExprId>, before: &[(Span, ExprId)]) {
        let Some((first, _)) = before.last().filter(|_| !self.context.library) else {
            return;
        };
        let link = Link {
            asks,
            before: before.iter().map(|(_, asks)| *asks).collect(),
            of_any_robot: !self.context.region.of_the_learner(),
        };
        let links = self.links.entry(at);
        links.or_insert_with(|| (*first, Vec::new())).1.push(link);
    }

    /// Warns of the branches that are never taken, since an earlier one is wherever they could be.
    pub fn branches_never_taken(&mut self) {
        let alone = self.has_one_robot();
        for (at, (first, links)) in std::mem::take(&mut self.links) {
            let program = &self.program;
            let never = |link: &Link| {
                let own = match link.asks {
                    Some(asks) => of_expr(program, asks, true),
                    None => Cases::constant(true),
                };
                let before = link.before.iter();
                let rest = before.fold(own.clone(), |rest, asks| {
                    rest.and(&of_expr(program, *asks, false))
                });
                !own.is_never() && own != Cases::Unknown && rest.is_never()
            };
            let reads_a_robot = |link: &Link| {
                let mut asked = link.asks.iter().chain(&link.before);
                asked.any(|asks| is_of_a_robot(&program.pool, *asks))
            };
            let unsure = |link: &Link| {
                let constant = |id| program.pool.constant(id).is_some();
                link.asks.is_some_and(constant)
                    || link.before.iter().any(|asks| constant(*asks))
                    || link.of_any_robot && !alone && reads_a_robot(link)
            };
            if links.iter().any(unsure) || !links.iter().all(never) {
                continue;
            }
            let label = match links.first().and_then(|link| link.asks) {
                Some(_) => "wherever this holds, a branch before it is taken",
                None => "in every case a branch before it is taken",
            };
            self.warning(Code::W0601, at, "this branch is never taken")
                .label(label)
                .also(first, "branches are looked at in their order");
        }
    }
}
