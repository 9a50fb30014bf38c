//! Declarations that nothing uses.

use super::mentions::Mentions;
use crate::check::names::Decl;
use crate::check::{Checker, Input};
use crate::diagnostic::{Code, suggest};
use crate::spelling::spelled;
use crate::syntax::ast::{
    Behavior, BehaviorBody, ClauseKind, Ident, Item, ItemKind, RobotEntryKind, State, World,
    WorldEntryKind,
};

impl<'a> Checker<'a> {
    /// Warns of what the main file declares and nothing uses. A file that neither sets a task nor has a tree is there
    /// for others to use.
    pub fn unused_declarations(&mut self, files: &[Input<'a>]) {
        let Some(main) = files.last() else { return };
        let is_root = |item: &&Item| matches!(item.kind, ItemKind::Task(_) | ItemKind::Tree(_));
        if !main.ast.items.iter().any(|item| is_root(&item)) {
            return;
        }
        let mentions = |library: bool| {
            let mut mentions = Mentions::default();
            let files = files.iter().filter(|input| input.library == library);
            for item in files.flat_map(|input| &input.ast.items) {
                mentions.item(item);
            }
            mentions
        };
        let (own, library) = (mentions(false), mentions(true));
        let is_task = |item: &Item| matches!(item.kind, ItemKind::Task(_));
        let tasked = main.ast.items.iter().any(is_task);
        for item in &main.ast.items {
            match &item.kind {
                ItemKind::World(world) => self.unused_in_world(world, &own, &library),
                _ => self.unused_item(item, &own, tasked),
            }
        }
    }

    /// `tasked` says whether the file sets a task: without one nothing happens that could set a state.
    fn unused_item(&mut self, item: &'a Item, mentions: &Mentions, tasked: bool) {
        match &item.kind {
            ItemKind::State(state) => {
                self.unused_state(&state.name, mentions);
                if tasked {
                    self.unset_state(state, mentions);
                }
            }
            ItemKind::Event(event) => {
                let help = "reward it, end the episode on it or let it have an effect";
                self.unused(&event.name, "event", help, mentions);
            }
            ItemKind::Let(shared) => {
                self.unused(&shared.name, "shared expression", "take it away", mentions);
            }
            // What is declared only is there for tables and environments, too.
            ItemKind::Predicate(predicate) if predicate.value.is_some() => {
                self.unused(&predicate.name, "predicate", "observe it", mentions);
            }
            ItemKind::Behavior(behavior) if !matches!(behavior.body, BehaviorBody::Declared) => {
                let help = "let a task choose it or a tree run it";
                self.unused(&behavior.name, "behaviour", help, mentions);
                self.unset_locals(item, behavior);
            }
            ItemKind::Enum(of) if !of.variants.iter().any(|one| mentioned(one, mentions)) => {
                self.unused(&of.name, "enum", "take it away", mentions);
            }
            ItemKind::Enum(of) if !mentions.ranged.contains(of.name.name.as_str()) => {
                for variant in &of.variants {
                    self.unused(variant, "variant", "set a state to it", mentions);
                }
            }
            ItemKind::Tree(tree) if tree.params.is_some() => {
                self.unused(&tree.name, "subtree", "use it in a tree", mentions);
            }
            _ => {}
        }
    }

    /// Only of sensors does the library know the names.
    fn unused_in_world(&mut self, world: &'a World, mentions: &Mentions, library: &Mentions) {
        let kinds = || {
            world
                .entries
                .iter()
                .filter_map(|entry| entry.kind.of_kind())
        };
        for entry in &world.entries {
            if let Some(kind) = entry
                .kind
                .of_kind()
                .filter(|kind| !mentioned(kind, mentions))
            {
                let spoken_of = kinds().filter(|kind| mentioned(kind, mentions));
                let spoken_of = spoken_of.map(|kind| kind.name.as_str());
                if let Some(meant) = suggest::nearest(&kind.name, spoken_of) {
                    let shown = quoted(&spelled(&kind.name));
                    let message = format!("nothing speaks of the kind {shown}");
                    self.warning(Code::W0201, kind.span, message)
                        .likely(kind, Some(meant));
                    self.kind_misspelt = true;
                    continue;
                }
            }
            match &entry.kind {
                WorldEntryKind::Place { name, of_kind, .. }
                    if !of_kind
                        .as_ref()
                        .is_some_and(|kind| mentioned(kind, mentions)) =>
                {
                    self.unused(name, "place", "take it away", mentions);
                }
                WorldEntryKind::Robot { entries, .. } => {
                    for entry in entries {
                        if let RobotEntryKind::Sensor { name, .. } = &entry.kind
                            && !mentioned(name, library)
                        {
                            self.unused(name, "sensor", "take it away", mentions);
                        }
                    }
                }
                _ => {}
            }
        }
    }

    fn unused(&mut self, name: &Ident, what: &str, help: &str, mentions: &Mentions) {
        if mentioned(name, mentions) || name.name.starts_with('_') {
            return;
        }
        let (shown, kept) = (spelled(&name.name), format!("_{}", name.name));
        let message = format!("nothing uses the {what} {}", quoted(&shown));
        self.warning(Code::W0201, name.span, message)
            .label("declared here, and never used")
            .help(format!(
                "{help}, or call it {} if it is to stay",
                quoted(&spelled(&kept))
            ));
    }

    fn unused_state(&mut self, name: &Ident, mentions: &Mentions) {
        if mentions.set.contains(name.name.as_str()) && !mentioned(name, mentions) {
            if name.name.starts_with('_') {
                return;
            }
            let (shown, kept) = (spelled(&name.name), format!("_{}", name.name));
            let message = format!("the state {} is set and never read", quoted(&shown));
            self.warning(Code::W0202, name.span, message)
                .label("nothing depends on it")
                .help(format!(
                    "read it in an event, a predicate or a reward, or call it {} if it is there for traces",
                    quoted(&spelled(&kept))
                ));
        } else {
            self.unused(name, "state", "read it", mentions);
        }
    }

    /// A state that something reads and nothing sets. A family may be a table of what its members are.
    fn unset_state(&mut self, state: &'a State, mentions: &Mentions) {
        let name = &state.name;
        let set =
            mentions.set.contains(name.name.as_str()) || self.hidden.contains(name.name.as_str());
        let params = state.params.iter().flat_map(|params| &params.params);
        let is_table = params.clone().any(|param| {
            let mut of = Mentions::default();
            of.expr(&state.value);
            mentioned(&param.name, &of)
        });
        if set || is_table || !mentioned(name, mentions) || name.name.starts_with('_') {
            return;
        }
        let help = match params.count() {
            0 => "set it in an effect, or name a constant by `let`",
            _ => "set it in an effect or in `start`",
        };
        self.never_set(name, "state", help);
    }

    /// The locals of a behaviour that start with a constant and that its control law does not set.
    fn unset_locals(&mut self, item: &'a Item, behavior: &'a Behavior) {
        let BehaviorBody::Clauses(clauses) = &behavior.body else {
            return;
        };
        let mut mentions = Mentions::default();
        mentions.item(item);
        for clause in clauses {
            let ClauseKind::Local { name, value, .. } = &clause.kind else {
                continue;
            };
            // What has a name already is kept under another one.
            let mut of = Mentions::default();
            of.expr(value);
            let mut named = of.read.iter().map(|name| self.names.value(name, false));
            let is_literal =
                named.all(|decl| matches!(decl, Some((Decl::Variant(..) | Decl::Place(..), _))));
            let set = mentions.set.contains(name.name.as_str());
            if is_literal && !set && mentioned(name, &mentions) && !name.name.starts_with('_') {
                self.never_set(
                    name,
                    "local",
                    "set it in `control`, or name a constant by `let`",
                );
            }
        }
    }

    fn never_set(&mut self, name: &Ident, what: &str, help: &str) {
        let shown = quoted(&spelled(&name.name));
        let message = format!("nothing ever sets the {what} {shown}");
        self.warning(Code::W0205, name.span, message)
            .label("it stays as it is declared here")
            .help(help);
    }
}

fn mentioned(name: &Ident, mentions: &Mentions) -> bool {
    mentions.read.contains(name.name.as_str())
}

/// A name in backquotes, which it may have already.
fn quoted(spelled: &str) -> String {
    if spelled.starts_with('`') {
        spelled.to_owned()
    } else {
        format!("`{spelled}`")
    }
}
