//! Items.

use super::columns::Group;
use super::{Printer, flat};
use crate::syntax::ast::{
    Behavior, BehaviorBody, Claim, ClaimWhat, Clause, ClauseKind, Enum, Expr, Ident, Item,
    ItemKind, Let, LetBody, On, Predicate, State, Trigger, TypeExpr, Use, UseWhat,
};

impl Printer<'_> {
    pub(super) fn items(&mut self, items: &[Item]) {
        let mut previous: Option<&Item> = None;
        for item in items {
            if self.remarks.is_none()
                && previous.is_some_and(|previous| !belong_together(previous, item))
            {
                self.blank = true;
            }
            self.item(item);
            previous = Some(item);
        }
        self.rest_of_file();
    }

    pub(super) fn item(&mut self, item: &Item) {
        self.entry(item.span, |printer| {
            printer.docs(&item.docs);
            printer.item_kind(item);
        });
    }

    /// The documentation, where there is no source whose comments hold it.
    pub(super) fn docs(&mut self, docs: &[String]) {
        if self.remarks.is_some() {
            return;
        }
        for doc in docs {
            let blank = if doc.is_empty() { "" } else { " " };
            self.write(&format!("///{blank}{doc}"));
            self.end_line(Group::Comment);
        }
    }

    fn item_kind(&mut self, item: &Item) {
        match &item.kind {
            ItemKind::Use(Use { what }) => {
                match &what.node {
                    UseWhat::Std => self.write("use std"),
                    UseWhat::Path(path) => self.write(&format!("use \"{path}\"")),
                }
                self.end_line(Group::None);
            }
            ItemKind::World(world) => self.world(world, item.span),
            ItemKind::Enum(kind) => self.enum_item(kind, item),
            ItemKind::State(state) => self.state(state),
            ItemKind::Event(event) => {
                let params = flat::maybe_params(event.params.as_ref());
                let head = format!("event {}{params}", flat::ident(&event.name));
                self.definition("event", &head, &event.value);
            }
            ItemKind::EachTick(block) => self.effect("each tick".to_owned(), block),
            ItemKind::On(on) => self.on_item(on),
            ItemKind::Let(item) => self.let_item(item),
            ItemKind::Predicate(predicate) => self.predicate(predicate),
            ItemKind::Behavior(behavior) => self.behavior(behavior, item),
            ItemKind::Task(task) => self.task(task, item.span),
            ItemKind::Learn(learn) => self.learn(learn, item.span),
            ItemKind::Tree(tree) => self.tree(tree),
            ItemKind::Claim(claim) => self.claim(claim),
            ItemKind::Error => {
                self.write("// not understood");
                self.end_line(Group::None);
            }
        }
    }

    fn enum_item(&mut self, item: &Enum, whole: &Item) {
        let head = format!("enum {} ", flat::ident(&item.name));
        let text = format!(
            "{{ {} }}",
            flat::joined(item.variants.iter().map(flat::ident))
        );
        self.write(&head);
        self.hoist(item.name.span.range().end);
        if self.fits(&text, whole.span, 0) {
            self.write(&text);
        } else {
            self.open_block(Group::None);
            self.trailing(self.mark_after("{", item.name.span.range().end));
            for variant in &item.variants {
                self.entry(variant.span, |printer| {
                    printer.write(&format!("{},", flat::ident(variant)));
                    printer.end_line(Group::None);
                });
            }
            self.rest_of_block(whole.span.range().end.saturating_sub(1));
            self.close_block();
        }
        self.end_line(Group::None);
    }

    fn state(&mut self, state: &State) {
        let params = flat::maybe_params(state.params.as_ref());
        let head = format!("state {}{params}", flat::ident(&state.name));
        self.declaration("state", &head, state.ty.as_ref(), &state.value);
    }

    /// `head: type = value`, in three columns.
    pub(super) fn declaration(
        &mut self,
        kind: &'static str,
        head: &str,
        ty: Option<&TypeExpr>,
        value: &Expr,
    ) {
        self.write(head);
        match ty {
            Some(ty) => {
                self.write(":");
                self.cell(&flat::type_expr(ty));
            }
            None => self.cell(""),
        }
        self.cell("= ");
        self.value(kind, value);
    }

    /// `head = value`, in two columns.
    pub(super) fn definition(&mut self, kind: &'static str, head: &str, value: &Expr) {
        self.write(head);
        self.cell("= ");
        self.value(kind, value);
    }

    /// The value at the end of a line; a line that is broken is not aligned.
    pub(super) fn value(&mut self, kind: &'static str, value: &Expr) {
        let before = self.ended;
        self.expr(value, 0);
        self.end_entry(kind, before);
    }

    /// Ends an entry that began after line `before`: it is aligned with its neighbours if it is one line.
    pub(super) fn end_entry(&mut self, kind: &'static str, before: usize) {
        let group = if self.ended == before {
            Group::Of(kind)
        } else {
            Group::None
        };
        self.end_line(group);
    }

    fn on_item(&mut self, on: &On) {
        let trigger = match &on.trigger {
            Trigger::Expr(trigger) => flat::expr(trigger),
            Trigger::Family { name, params } => {
                format!("{}{}", flat::ident(name), flat::params(params))
            }
        };
        self.effect(format!("on {trigger}"), &on.block);
    }

    fn effect(&mut self, head: String, block: &crate::syntax::ast::Block) {
        self.write(&head);
        self.cell("");
        let before = self.ended;
        self.block(block, 0);
        self.end_entry("effect", before);
    }

    fn let_item(&mut self, item: &Let) {
        self.write(&format!("let {}", flat::ident(&item.name)));
        let before = self.ended;
        let ty = item.ty.as_ref().map(flat::type_expr);
        self.params(item.params.as_ref(), ty.as_ref().map_or(0, String::len) + 4);
        match ty {
            Some(ty) => {
                self.write(":");
                self.cell(&ty);
            }
            None => self.cell(""),
        }
        self.cell("= ");
        match &item.body {
            LetBody::Expr(value) => self.expr(value, 0),
            LetBody::Yield(value) => {
                self.hoist(value.span.range().start);
                let text = flat::yields(value);
                let broken = !value.bindings.is_empty()
                    || self.is_written_broken(value.span).unwrap_or(false);
                if !broken && self.fits(&text, value.span, 0) {
                    self.write(&text);
                } else {
                    self.yields(value);
                }
            }
        }
        self.end_entry("let", before);
    }

    fn predicate(&mut self, predicate: &Predicate) {
        let params = flat::maybe_params(predicate.params.as_ref());
        let head = format!("predicate {}{params}", flat::ident(&predicate.name));
        match &predicate.value {
            Some(value) => self.definition("predicate", &head, value),
            None => {
                self.write(&head);
                self.end_line(Group::Of("predicate"));
            }
        }
    }

    fn behavior(&mut self, behavior: &Behavior, item: &Item) {
        self.write(&format!("behavior {}", flat::ident(&behavior.name)));
        let before = self.ended;
        self.params(behavior.params.as_ref(), 2);
        match &behavior.body {
            BehaviorBody::Declared => self.end_line(Group::None),
            BehaviorBody::Alias(call) => {
                self.cell("= ");
                self.call(call, 0);
                self.end_entry("behavior", before);
            }
            BehaviorBody::Clauses(clauses) => {
                let head = behavior
                    .params
                    .as_ref()
                    .map_or(behavior.name.span, |params| params.span);
                self.write(" ");
                self.begin_braces(head.range().end);
                for clause in clauses {
                    self.entry(clause.span, |printer| printer.clause(clause));
                }
                self.end_braces(item.span.range().end, clauses.is_empty());
            }
        }
    }

    fn clause(&mut self, clause: &Clause) {
        match &clause.kind {
            ClauseKind::Local { name, ty, value } => {
                let head = format!("local {}", flat::ident(name));
                self.declaration("local", &head, ty.as_ref(), value);
            }
            ClauseKind::Requires(value) => self.worded("requires ", value),
            ClauseKind::Succeed(value) => self.worded("succeed when ", value),
            ClauseKind::Fail(value) => self.worded("fail when ", value),
            ClauseKind::Control(block) => {
                self.write("control ");
                self.block(block, 0);
                self.end_line(Group::None);
            }
            ClauseKind::Error => self.end_line(Group::None),
        }
    }

    /// A word and a value.
    pub(super) fn worded(&mut self, word: &str, value: &Expr) {
        self.write(word);
        self.expr(value, 0);
        self.end_line(Group::None);
    }

    fn claim(&mut self, claim: &Claim) {
        let name = |ident: &Ident| flat::ident(ident);
        let mut text = format!("claim {} ", name(&claim.tree));
        text.push_str(&match &claim.what {
            ClaimWhat::Equals(other) => format!("equals {}", name(other)),
            ClaimWhat::Never(event) => format!("never {}", flat::expr(event)),
            ClaimWhat::Reaches(event) => format!("reaches {}", flat::expr(event)),
        });
        if let Some(within) = &claim.within {
            text.push_str(&format!(" within {}", flat::expr(within)));
        }
        if let Some((strict, least)) = &claim.probability {
            let sign = if *strict { ">" } else { ">=" };
            let least = flat::at_least(least, flat::Level::Sum);
            text.push_str(&format!(" with probability {sign} {least}"));
        }
        self.write(&text);
        self.end_line(Group::None);
    }

    /// The opening brace of a block whose head ends at byte `head`.
    pub(super) fn begin_braces(&mut self, head: usize) {
        let open = self.mark_after("{", head);
        self.hoist(open.saturating_sub(1));
        self.open_block(Group::None);
        self.trailing(open);
    }

    /// The closing brace of a block that ends at byte `end`, with the comments before it.
    pub(super) fn end_braces(&mut self, end: usize, empty: bool) {
        let opened = self.lines.len();
        self.rest_of_block(end.saturating_sub(1));
        let bare = self.lines.len() == opened
            && empty
            && self.lines.last().is_some_and(|line| line.comment.is_none());
        if bare && let Some(line) = self.lines.pop() {
            self.cells = line.cells;
            self.begun = Some(line.indent);
            self.blank = line.blank_before;
        }
        self.close_block();
        self.end_line(Group::None);
    }
}

/// Whether two items without a source stand on adjacent lines.
fn belong_together(a: &Item, b: &Item) -> bool {
    let is_line = |item: &Item| {
        matches!(
            item.kind,
            ItemKind::Use(_)
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
