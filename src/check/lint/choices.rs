//! Behaviours to choose from that do the same under two names.

use crate::check::Checker;
use crate::check::expr::plain_ref;
use crate::check::lint::mentions::Mentions;
use crate::diagnostic::Code;
use crate::source::Span;
use crate::syntax::ast::{
    AspectKind, Behavior, BehaviorBody, Expr, ExprKind, Ident, Item, ItemKind, Ref,
};
use crate::syntax::print;
use std::collections::BTreeMap;

/// How many aliases may stand for one another.
const ALIASES: usize = 16;

impl<'a> Checker<'a> {
    /// Warns of choices of a task that are one behaviour under two names.
    pub fn choices_alike(&mut self, items: impl Iterator<Item = &'a Item> + Clone) {
        let behaviors = || items.clone().filter_map(behavior);
        let by_name: BTreeMap<&str, &'a Behavior> = behaviors()
            .map(|behavior| (behavior.name.name.as_str(), behavior))
            .collect();
        let mut mentions = Mentions::default();
        items.clone().for_each(|item| mentions.beside_choices(item));
        // What only its name tells from another is another where something asks for that name.
        let is_asked_for = |name: &str| mentions.read.contains(name);
        for item in items.clone() {
            let ItemKind::Task(task) = &item.kind else {
                continue;
            };
            let lists = task.aspects.iter().filter_map(|aspect| match &aspect.kind {
                AspectKind::Choose(list) => Some(list),
                _ => None,
            });
            let mut seen: BTreeMap<String, (Span, String, &str)> = BTreeMap::new();
            for chosen in lists.flatten().filter_map(plain_ref) {
                let name = call(chosen);
                let (does, own) = does(&by_name, chosen);
                match seen.get(&does) {
                    Some((_, _, other))
                        if own != *other && (is_asked_for(own) || is_asked_for(other)) => {}
                    Some((first, other, _)) => {
                        let (first, message) =
                            (*first, format!("`{name}` does the same as `{other}`"));
                        self.warning(Code::W0518, chosen.span, message)
                            .label("to choose between the two makes no difference")
                            .also(first, "in the list already");
                    }
                    None => {
                        seen.insert(does, (chosen.span, name, own));
                    }
                }
            }
        }
    }
}

fn behavior(item: &Item) -> Option<&Behavior> {
    match &item.kind {
        ItemKind::Behavior(behavior) => Some(behavior),
        _ => None,
    }
}

/// What a behaviour does, as text: what an alias stands for, or the clauses of a behaviour without parameters; with the name of
/// what it stands for.
fn does<'a>(by_name: &BTreeMap<&str, &'a Behavior>, mut chosen: &'a Ref) -> (String, &'a str) {
    for _ in 0..ALIASES {
        let plain = chosen.args.as_ref().is_none_or(Vec::is_empty);
        let named = by_name.get(chosen.name.name.as_str());
        let Some(behavior) = named.filter(|behavior| plain && behavior.params.is_none()) else {
            break;
        };
        match &behavior.body {
            BehaviorBody::Alias(of) => chosen = of,
            BehaviorBody::Clauses(_) => return (body(behavior), &chosen.name.name),
            BehaviorBody::Declared => break,
        }
    }
    (call(chosen), &chosen.name.name)
}

/// A behaviour without its name.
fn body(behavior: &Behavior) -> String {
    let name = Ident {
        name: "_".to_owned(),
        span: behavior.name.span,
    };
    print::item(&Item {
        docs: Vec::new(),
        kind: ItemKind::Behavior(Behavior {
            name,
            ..behavior.clone()
        }),
        span: behavior.name.span,
    })
}

/// A behaviour as it is called.
fn call(reference: &Ref) -> String {
    print::expr(&Expr {
        kind: ExprKind::Ref(reference.clone()),
        span: reference.span,
    })
}
