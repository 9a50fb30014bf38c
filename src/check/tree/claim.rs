//! Claims on trees.

use crate::check::Checker;
use crate::check::context::{Context, Region};
use crate::check::names::{Decl, LEARNED};
use crate::check::report::{LISTED, listed};
use crate::check::types::Type;
use crate::diagnostic::{Applicability, Code};
use crate::ir::program::Event;
use crate::ir::task::{Claim, ClaimKind, Occurrence, TreeRef};
use crate::ir::{Id, Name};
use crate::syntax::ast::{self, BinaryOp, ClaimWhat, Expr, ExprKind, Ident, Item, ItemKind};
use crate::syntax::print;

/// Below this, the probability of `never` is likely meant as that of the event.
const SELDOM: f64 = 0.2;

impl<'a> Checker<'a> {
    /// `claim tree equals tree`, `claim tree never event …`
    pub fn claim(&mut self, claim: &'a ast::Claim) {
        self.context = Context::new(Region::Tree);
        let tree = self.tree_ref(&claim.tree);
        let kind = match &claim.what {
            ClaimWhat::Equals(other) => {
                if other.name == claim.tree.name {
                    self.warning(Code::W0303, other.span, "a tree is equal to itself")
                        .label("the same as on the left");
                }
                let other = self.tree_ref(other);
                self.no_terms(claim);
                other.map(ClaimKind::Equals)
            }
            ClaimWhat::Never(event) => self.occurrence(claim, event).map(ClaimKind::Never),
            ClaimWhat::Reaches(event) => self.occurrence(claim, event).map(ClaimKind::Reaches),
        };
        if let (Some(tree), Some(kind)) = (tree, kind) {
            self.program.claims.push(Claim {
                tree,
                text: written(claim),
                kind,
            });
        }
    }

    /// A tree of the program, or one that a learner will learn.
    fn tree_ref(&mut self, name: &Ident) -> Option<TreeRef> {
        let called = Name::word(&name.name);
        let learner = self.names.learners.get(name.name.as_str());
        if let Some(learner) = learner.and_then(|learn| learn.name.as_ref()) {
            self.stands_for(name, learner.span);
        }
        self.value_of(name);
        if let Some(id) = self.program.trees.named(&called) {
            return Some(TreeRef::Tree(id));
        }
        if let Some(id) = self.program.learners.named(&called) {
            return Some(TreeRef::Learned(id));
        }
        let known = self.names.learners.contains_key(name.name.as_str());
        match self.names.value(&name.name, false) {
            // Declared, with mistakes that were reported.
            Some((Decl::Tree(tree), _)) if tree.params.is_none() => {
                self.needed.push((tree, name.span));
            }
            _ if known => {}
            // Its parameters are told of where they stand.
            Some((Decl::Tree(tree), _))
                if (tree.params.iter().flat_map(|params| &params.params))
                    .any(|param| param.ty.factors.is_empty()) => {}
            Some((Decl::Tree(_), _)) => self
                .error(
                    Code::E0203,
                    name.span,
                    format!("the tree `{}` has parameters", name.name),
                )
                .label("a claim is about a whole tree")
                .emit(),
            Some((decl, false)) => self
                .error(Code::E0203, name.span, "a tree is needed here")
                .label(format!("`{}` is {}", name.name, decl.what()))
                .emit(),
            _ if name.name == LEARNED
                && self.names.learners.is_empty()
                && !self.names.is_lost(LEARNED) =>
            {
                let message = format!("`{}` is not declared", name.name);
                self.error(Code::E0202, name.span, message)
                    .label("the tree of a learner, and there is none")
                    .help("what learns is an item: `learn TASK { episodes = 1_000 }`")
                    .emit();
            }
            _ => {
                let trees = self.names.values(|decl| matches!(decl, Decl::Tree(_)));
                let trees = trees.chain(self.names.learners.keys().copied());
                let trees: Vec<&str> = trees.collect();
                let likely = self.likely(&name.name, trees.iter().copied());
                let all = (likely.is_none() && (1..=LISTED).contains(&trees.len()))
                    .then(|| format!("there is {}", listed(&trees, "and")));
                self.undeclared(name, "tree", likely).or_help(all);
            }
        }
        None
    }

    fn no_terms(&mut self, claim: &'a ast::Claim) {
        let term = claim
            .within
            .as_ref()
            .or(claim.probability.as_ref().map(|(_, p)| p));
        if let Some(term) = term {
            self.error(
                Code::E0608,
                term.span,
                "that two trees are equal is proved, not estimated",
            )
            .label("neither `within` nor `with probability` belongs here");
        }
    }

    fn occurrence(&mut self, claim: &'a ast::Claim, event: &'a Expr) -> Option<Occurrence> {
        let event = self.claimed_event(event);
        let within = claim
            .within
            .as_ref()
            .map(|time| self.ticks(time, "`within`"));
        let probability = claim.probability.as_ref().map(|(more, p)| {
            let typed = self.expect(p, &Type::Ratio, "a probability");
            self.probability(&typed, "a probability")?;
            let least = self.constant_part(typed.scalar()?, p.span, "a probability")?;
            if *more && least >= 1.0 {
                let why = "no probability is more than 100%";
                return self.out_of_range(p.span, why, "more than this").none();
            }
            if matches!(claim.what, ClaimWhat::Never(_)) && least < SELDOM {
                self.mostly(claim, p, least);
            }
            Some(least)
        });
        Some(Occurrence {
            event: event?,
            within: match within {
                Some(ticks) => Some(ticks?),
                None => None,
            },
            probability: match probability {
                Some(value) => value?,
                None => 1.0,
            },
        })
    }

    /// Warns of `never` that is to hold in few of the episodes: the probability is that of what is claimed, not
    /// that of the event.
    fn mostly(&mut self, claim: &ast::Claim, probability: &Expr, least: f64) {
        let percent = |part: f64| format!("{}%", (part * 1e10).round() / 1e8);
        let (least, most) = (percent(least), percent(1.0 - least));
        let tree = &claim.tree.name;
        let message = format!("this allows the event in up to {most} of the episodes");
        self.warning(Code::W0520, probability.span, message)
            .label("how probable it is that it never happens")
            .fix(
                format!(
                    "if at most {least} of the episodes of `{tree}` may have it, write `{most}`"
                ),
                probability.span,
                most,
                Applicability::Unsafe,
            );
    }

    fn claimed_event(&mut self, event: &'a Expr) -> Option<Id<Event>> {
        if let ExprKind::Binary { op, left, right } = &event.kind
            && let ExprKind::Ref(reference) = &left.kind
            && matches!(op.node, BinaryOp::Ge | BinaryOp::Gt)
            && matches!(
                self.names.value(&reference.name.name, false),
                Some((Decl::Event(_), _))
            )
        {
            let place = op.span.to(right.span);
            let right = format!("with probability >= {}", print::expr(right));
            return self
                .error(Code::E0608, place, "how probable it is stands behind words")
                .write(place, right, Applicability::Unsafe)
                .none();
        }
        let ExprKind::Ref(reference) = &event.kind else {
            let declaration = format!("event NAME = {}", print::expr(event));
            self.not_named(event, "an event", &declaration);
            return None;
        };
        let asked = print::expr(event);
        let help = match self.names.value(&reference.name.name, false) {
            Some((Decl::Predicate(_), _)) => Some(format!("declare one: `event NAME = {asked}`")),
            Some((Decl::Behavior(_), _)) => {
                Some(format!("declare one: `event NAME = success({asked})`"))
            }
            Some((Decl::Place(..), _)) => Some(format!(
                "declare one: `event NAME = success(goto({asked}))`"
            )),
            _ => None,
        };
        let (decl, _) = self.declared_as(reference, "an event", help, |decl| match decl {
            Decl::Event(decl) => Some(decl),
            _ => None,
        })?;
        let codes = match &decl.params {
            Some(params) => {
                let scope = self.bind_arguments(Some(params), false, reference)?;
                self.member_codes(&scope)?
            }
            None if self.gives_arguments(reference, "an event") => return None,
            None => Vec::new(),
        };
        let family = self.events.get(decl.name.name.as_str())?;
        let member = family.iter().find(|member| member.codes == codes)?;
        Some(member.is)
    }
}

/// A claim as the language writes it.
pub fn written(claim: &ast::Claim) -> String {
    let item = Item {
        docs: Vec::new(),
        kind: ItemKind::Claim(claim.clone()),
        span: claim.tree.span,
    };
    print::item(&item).trim().to_owned()
}
