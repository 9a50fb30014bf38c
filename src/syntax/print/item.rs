//! Items.

use super::Printer;
use super::columns::Align;
use super::doc::{Brackets, Break, Doc, Entry, row};
use super::expr::typed;
use super::levels::Level;
use super::names::{ident, type_expr};
use crate::syntax::ast::{
    Behavior, BehaviorBody, Claim, ClaimWhat, Clause, ClauseKind, Enum, Ident, Input, InputKind,
    Item, ItemKind, Let, LetBody, On, Predicate, Trigger, UseWhat,
};

impl Printer<'_> {
    pub(super) fn items<'a>(&self, items: &'a [Item]) -> Vec<Entry<'a>> {
        let mut entries: Vec<Entry<'a>> = items.iter().map(|item| self.item(item)).collect();
        for (entry, pair) in entries.iter_mut().skip(1).zip(items.windows(2)) {
            entry.apart = matches!(pair, [above, item] if !belong_together(above, item));
        }
        entries
    }

    pub(super) fn item<'a>(&self, item: &'a Item) -> Entry<'a> {
        let (align, doc) = match &item.kind {
            ItemKind::Use(item) => (
                Align::None,
                match &item.what.node {
                    UseWhat::Std => Doc::from("use std"),
                    UseWhat::Path(path) => match &item.pin {
                        None => row!["use \"", path.as_str(), "\""],
                        Some(pin) => {
                            row!["use \"", path.as_str(), "\" sha256:", pin.node.as_str()]
                        }
                    },
                },
            ),
            ItemKind::World(world) => (Align::None, self.world(world, item.span)),
            ItemKind::Enum(kind) => (Align::None, self.enum_item(kind, item)),
            ItemKind::Input(input) => (Align::None, self.input(input, item)),
            ItemKind::State(state) => {
                let params = self.flat_params(state.params.as_ref());
                let head = row!["state ", ident(&state.name), params];
                let doc = self.declaration(head, state.ty.as_ref(), &state.value);
                (Align::Of("state"), doc)
            }
            ItemKind::Event(event) => {
                let params = self.flat_params(event.params.as_ref());
                let head = row!["event ", ident(&event.name), params];
                (Align::Of("event"), self.definition(head, &event.value))
            }
            ItemKind::EachTick(block) => {
                let doc = row!["each tick", Doc::column(), self.block(block, false)];
                (Align::Of("effect"), doc)
            }
            ItemKind::On(on) => (Align::Of("effect"), self.on_item(on)),
            ItemKind::Let(item) => (Align::Of("let"), self.let_item(item)),
            ItemKind::Predicate(predicate) => (Align::Of("predicate"), self.predicate(predicate)),
            ItemKind::Behavior(behavior) => self.behavior(behavior, item),
            ItemKind::Task(task) => (Align::None, self.task(task, item.span)),
            ItemKind::Learn(learn) => (Align::None, self.learn(learn, item.span)),
            ItemKind::Tree(tree) => (Align::None, self.tree(tree)),
            ItemKind::Claim(claim) => (Align::None, self.claim(claim).flat()),
            ItemKind::Test(test) => (Align::None, self.test(test, item.span)),
            ItemKind::Error => (Align::None, Doc::from("// not understood")),
        };
        Entry::aligned(item.span, align, doc).documented(&item.docs)
    }

    fn enum_item<'a>(&self, item: &'a Enum, whole: &Item) -> Doc<'a> {
        let head = item.name.span.range().end;
        let list = self.names(&item.variants, head, whole, Brackets::BRACES);
        row!["enum ", ident(&item.name), " ", Doc::hoist(head), list]
    }

    fn input<'a>(&self, item: &'a Input, whole: &Item) -> Doc<'a> {
        let head = item.name.span.range().end;
        let kind = match &item.kind {
            InputKind::Number(ty) => type_expr(ty),
            InputKind::Category(values) => row![
                Doc::hoist(head),
                self.names(values, head, whole, Brackets::VALUES)
            ],
        };
        row!["input ", ident(&item.name), ": ", kind]
    }

    /// Names in braces behind the head of an item.
    fn names<'a>(
        &self,
        names: &'a [Ident],
        head: usize,
        whole: &Item,
        brackets: Brackets,
    ) -> Doc<'a> {
        let names = names.iter();
        let names = names.map(|name| Entry::new(name.span, ident(name)));
        let inside = self.braces_after(head, whole.span);
        Doc::list(brackets, inside, names.collect()).grouped(inside, Break::TooLong)
    }

    fn on_item<'a>(&self, on: &'a On) -> Doc<'a> {
        let trigger = match &on.trigger {
            Trigger::Expr(trigger) => self.expr(trigger).flat(),
            Trigger::Family { name, params } => {
                row![ident(name), self.flat_params(Some(params))]
            }
        };
        row!["on ", trigger, Doc::column(), self.block(&on.block, false)]
    }

    fn let_item<'a>(&self, item: &'a Let) -> Doc<'a> {
        let ty = item.ty.as_ref().map_or(0, |ty| type_expr(ty).width);
        let params = self.params(item.params.as_ref()).room(ty + ":  =".len());
        let head = row!["let ", ident(&item.name), params];
        let body = match &item.body {
            LetBody::Expr(value) => self.expr(value),
            LetBody::Yield(value) => {
                let doc = self.yields(value);
                let tall = doc.tall;
                row![
                    Doc::hoist(value.span.range().start),
                    doc.grouped(value.span, Break::always_if(tall))
                ]
            }
        };
        row![typed(head, item.ty.as_ref()), body]
    }

    fn predicate<'a>(&self, predicate: &'a Predicate) -> Doc<'a> {
        let params = self.flat_params(predicate.params.as_ref());
        let head = row!["predicate ", ident(&predicate.name), params];
        match &predicate.value {
            Some(value) => self.definition(head, value),
            None => head,
        }
    }

    fn behavior<'a>(&self, behavior: &'a Behavior, item: &Item) -> (Align, Doc<'a>) {
        let params = self.params(behavior.params.as_ref()).room(" {".len());
        let head = row!["behavior ", ident(&behavior.name), params];
        match &behavior.body {
            BehaviorBody::Declared => (Align::None, head),
            BehaviorBody::Alias(call) => (
                Align::Of("behavior"),
                row![head, Doc::column(), "= ", self.call(call)],
            ),
            BehaviorBody::Clauses(clauses) => {
                let params = behavior.params.as_ref().map(|params| params.span);
                let end = params.unwrap_or(behavior.name.span).range().end;
                let clauses = clauses.iter().map(|clause| self.clause(clause)).collect();
                let doc = row![head, " ", self.braces(end, item.span, clauses)];
                (Align::None, doc)
            }
        }
    }

    fn clause<'a>(&self, clause: &'a Clause) -> Entry<'a> {
        let doc = match &clause.kind {
            ClauseKind::Local { name, ty, value } => {
                let head = row!["local ", ident(name)];
                let doc = self.declaration(head, ty.as_ref(), value);
                return Entry::aligned(clause.span, Align::Of("local"), doc);
            }
            ClauseKind::Requires(value) => row!["requires ", self.expr(value)],
            ClauseKind::Succeed(value) => row!["succeed when ", self.expr(value)],
            ClauseKind::Fail(value) => row!["fail when ", self.expr(value)],
            ClauseKind::Control(block) => row!["control ", self.block(block, true)],
            ClauseKind::Error => Doc::nothing(),
        };
        Entry::new(clause.span, doc)
    }

    fn claim<'a>(&self, claim: &'a Claim) -> Doc<'a> {
        let what = match &claim.what {
            ClaimWhat::Equals(other) => row!["equals ", ident(other)],
            ClaimWhat::Never(event) => row!["never ", self.expr(event)],
            ClaimWhat::Reaches(event) => row!["reaches ", self.expr(event)],
        };
        let mut parts = vec![row!["claim ", ident(&claim.tree), " ", what]];
        if let Some(within) = &claim.within {
            parts.push(row![" within ", self.expr(within)]);
        }
        if let Some((strict, least)) = &claim.probability {
            let sign = if *strict { ">" } else { ">=" };
            let least = self.operand(least, Level::Sum);
            parts.push(row![" with probability ", sign, " ", least]);
        }
        Doc::row(parts)
    }
}

/// Whether two items without a source stand on adjacent lines.
fn belong_together(a: &Item, b: &Item) -> bool {
    let is_line = |item: &Item| {
        matches!(
            item.kind,
            ItemKind::Use(_)
                | ItemKind::Input(_)
                | ItemKind::State(_)
                | ItemKind::Event(_)
                | ItemKind::Predicate(_)
                | ItemKind::Behavior(Behavior {
                    body: BehaviorBody::Declared,
                    ..
                })
                | ItemKind::EachTick(_)
                | ItemKind::On(_)
                | ItemKind::Claim(_)
        )
    };
    let effect = |item: &Item| matches!(item.kind, ItemKind::EachTick(_) | ItemKind::On(_));
    let same = std::mem::discriminant(&a.kind) == std::mem::discriminant(&b.kind)
        || effect(a) && effect(b);
    same && is_line(a) && b.docs.is_empty()
}
