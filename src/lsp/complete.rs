//! What can be written at a cursor.

use super::analysis::Analysis;
use super::cursor::{Before, Wanted};
use super::hover::{explained, markdown, of_outlined};
use super::outline::Outlined;
use super::reference::{self, Form};
use super::signature;
use super::symbols::what;
use crate::check::{Entity, built_in_names, built_in_types, methods};
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::words::{ITEMS, NODES, UNITS};
use gen_lsp_types::{CompletionItem, CompletionItemKind, Documentation, InsertTextFormat};
use std::collections::BTreeSet;

/// What can be written at a byte of the main file, each name once.
pub(super) fn complete(analysis: &Analysis, byte: u32, snippets: bool) -> Vec<CompletionItem> {
    let before = Before::new(analysis.text(), &analysis.tokens, byte as usize);
    let mut list = List {
        analysis,
        outlines: analysis.outlines(),
        items: Vec::new(),
        names: BTreeSet::new(),
        byte,
        snippets,
    };
    let wanted = before.wanted();
    let call = before.call().filter(|call| call.name.is_none());
    if let Some(call) = call.filter(|_| matches!(wanted, Wanted::Value | Wanted::Behavior)) {
        list.parameters(call.callee.of(analysis.text()));
    }
    list.wanted(wanted);
    list.items
}

/// The completions that are found, in the order in which they are shown.
struct List<'a> {
    analysis: &'a Analysis,
    outlines: Vec<Outlined<'a>>,
    items: Vec<CompletionItem>,
    names: BTreeSet<String>,
    byte: u32,
    snippets: bool,
}

impl List<'_> {
    fn wanted(&mut self, wanted: Wanted) {
        use Entity as E;
        match wanted {
            Wanted::Nothing => {}
            Wanted::Item => self.words(ITEMS),
            Wanted::Use => self.words(["std"]),
            Wanted::World => self.section("The world", |form| !form.is_called()),
            Wanted::Robot => self.section("The robot", |form| !form.is_called()),
            Wanted::Sensor => self.section("The robot", Form::is_called),
            Wanted::Clause => {
                self.words(["local"]);
                self.section("Behaviours", |form| !form.is_called());
            }
            Wanted::Aspect => self.section("Tasks", |form| {
                let of_start = ["pose", "position", "heading", "STATE"];
                !form.is_called()
                    && !form.written.starts_with("history =")
                    && !of_start.contains(&form.word)
            }),
            Wanted::RewardLine => self.words(["on", "per", "while", "otherwise"]),
            Wanted::StartLine => {
                self.words(["pose", "position", "heading", "history"]);
                self.declared(&[E::State]);
            }
            Wanted::Setting => self.section("Learners", |form| form.word != "learn"),
            Wanted::Method => {
                for name in methods() {
                    self.word(name, CompletionItemKind::EnumMember);
                }
            }
            Wanted::Statement => {
                self.words(["let", "if", "for"]);
                self.word("drive", CompletionItemKind::Function);
                self.bound();
            }
            Wanted::Effect => {
                self.words(["let", "if", "for"]);
                self.declared(&[E::State]);
                self.bound();
            }
            Wanted::Unit => {
                for unit in UNITS {
                    self.word(unit, CompletionItemKind::Unit);
                }
            }
            Wanted::Type => {
                for name in built_in_types() {
                    self.word(name, CompletionItemKind::Class);
                }
                self.declared(&[E::Enum, E::Kind]);
            }
            Wanted::Kind => self.declared(&[E::Kind]),
            Wanted::Domain => {
                self.declared(&[E::Kind, E::Enum]);
                self.words(["place", "wall", "robot"]);
            }
            Wanted::Shape => self.section("The world", Form::is_called),
            Wanted::Body => {
                for word in ["disc", "differential", "holonomic", "stop", "slide"] {
                    self.word(word, CompletionItemKind::Value);
                }
            }
            Wanted::Predicate => self.declared(&[E::Predicate]),
            Wanted::Behavior => self.declared(&[E::Behavior]),
            Wanted::Event => {
                self.declared(&[E::Event]);
                self.words(["success", "failure"]);
            }
            Wanted::Task => self.declared(&[E::Task]),
            Wanted::Tree => self.declared(&[E::Tree, E::Learner]),
            Wanted::Node => {
                self.declared(&[E::Predicate, E::Behavior, E::Tree]);
                self.words(["memory", "not"]);
                for (word, _) in NODES {
                    self.word(word, CompletionItemKind::Keyword);
                }
                self.words(["done", "failed"]);
                self.bound();
            }
            Wanted::Guard => {
                self.declared(&[E::Predicate]);
                self.words(["not", "done", "failed"]);
                self.bound();
            }
            Wanted::TestLine => self.words(["given", "tick"]),
            Wanted::Expected => self.declared(&[E::Behavior, E::Tree]),
            Wanted::Outcome => self.words(["success", "failure"]),
            Wanted::Value => self.values(),
        }
    }

    fn values(&mut self) {
        use Entity as E;
        self.bound();
        self.declared(&[
            E::Input,
            E::State,
            E::Place,
            E::Wall,
            E::Sensor,
            E::Robot,
            E::Predicate,
            E::Event,
            E::Let,
            E::Variant,
            E::Behavior,
        ]);
        for name in built_in_names() {
            self.word(name, CompletionItemKind::Function);
        }
        self.words(["if", "not", "true", "false"]);
    }

    fn words<const N: usize>(&mut self, words: [&str; N]) {
        for word in words {
            self.word(word, CompletionItemKind::Keyword);
        }
    }

    fn section(&mut self, section: &str, wanted: impl Fn(&Form) -> bool) {
        for form in reference::under(section).filter(|form| wanted(form)) {
            let kind = match form.is_called() {
                true => CompletionItemKind::Function,
                false => CompletionItemKind::Keyword,
            };
            self.word(form.word, kind);
        }
    }

    /// A word of the language, with what the reference says of it.
    fn word(&mut self, word: &str, kind: CompletionItemKind) {
        let said = explained(word);
        self.add(CompletionItem {
            label: word.to_owned(),
            kind: Some(kind),
            documentation: said.map(|said| Documentation::MarkupContent(markdown(said))),
            ..CompletionItem::default()
        });
    }

    fn add(&mut self, item: CompletionItem) {
        if self.names.insert(item.label.clone()) {
            // Editors sort by this, so that what is nearer to hand stays first.
            let rank = format!("{:04}", self.items.len());
            self.items.push(CompletionItem {
                sort_text: Some(rank),
                ..item
            });
        }
    }

    /// What is declared, of these sorts, the user's first.
    fn declared(&mut self, entities: &[Entity]) {
        let meanings = &self.analysis.loaded.meanings;
        let mut found: Vec<(bool, usize, Span)> = Vec::new();
        for (span, entity) in meanings.declared() {
            let Some(rank) = entities.iter().position(|it| *it == entity) else {
                continue;
            };
            let library = self.analysis.path(span.file).is_none();
            let name = crate::spelling::bare(self.analysis.written(span));
            // Of what the library declares, only what no declaration of the user hides.
            let hidden = library && meanings.value(name) != Some(span);
            let helper = library && !matches!(entity, Entity::Behavior);
            if !hidden && !helper {
                found.push((library, rank, span));
            }
        }
        found.sort();
        for (_, _, span) in found {
            if let Some(item) = self.item(span) {
                self.add(item);
            }
        }
    }

    fn item(&self, declared: Span) -> Option<CompletionItem> {
        let entity = self.analysis.loaded.meanings.entity(declared)?;
        let name = crate::spelling::bare(self.analysis.written(declared)).to_owned();
        let spelled = spelled(&name).into_owned();
        let found = self
            .outlines
            .iter()
            .find_map(|outlined| outlined.find(declared));
        let ty = self.analysis.loaded.meanings.written_type(declared);
        let mut detail = what(entity).to_owned();
        let mut item = CompletionItem {
            kind: Some(kind(entity)),
            insert_text: (spelled != name).then(|| spelled.clone()),
            ..CompletionItem::default()
        };
        if let Some(found) = found {
            let said = of_outlined(self.analysis, found);
            item.documentation = Some(Documentation::MarkupContent(markdown(said)));
            if found.params.is_some() {
                detail = signature::head(self.analysis, found).0;
                item.insert_text = Some(self.call(&spelled, found));
                item.insert_text_format = self.snippets.then_some(InsertTextFormat::Snippet);
            }
        }
        if let Some(ty) = ty.filter(|_| {
            matches!(
                entity,
                Entity::Input | Entity::State | Entity::Let | Entity::Parameter | Entity::Local
            )
        }) {
            detail = format!("{detail}: {ty}");
        }
        Some(CompletionItem {
            label: name,
            detail: Some(detail),
            ..item
        })
    }

    /// A call with the parameters that have no default, as places to fill in.
    fn call(&self, name: &str, found: &Outlined) -> String {
        let params = found.params.iter().flat_map(|params| &params.params);
        let needed: Vec<&str> = params
            .filter(|param| param.default.is_none())
            .map(|param| param.name.name.as_str())
            .collect();
        if needed.is_empty() || !self.snippets {
            return name.to_owned();
        }
        let numbered = needed.iter().enumerate();
        let places = numbered.map(|(index, name)| format!("${{{}:{name}}}", index + 1));
        let places: Vec<String> = places.collect();
        format!("{}({})", name.replace('$', "\\$"), places.join(", "))
    }

    /// The names of parameters that what is called takes.
    fn parameters(&mut self, callee: &str) {
        let Some(declared) = self
            .analysis
            .loaded
            .meanings
            .value(crate::spelling::bare(callee))
        else {
            return;
        };
        let found = self
            .outlines
            .iter()
            .find_map(|outlined| outlined.find(declared));
        let params = found.and_then(|found| found.params);
        let params = params.iter().flat_map(|params| &params.params);
        let items: Vec<CompletionItem> = params
            .filter(|param| param.default.is_some())
            .map(|param| CompletionItem {
                label: format!("{} =", param.name.name),
                kind: Some(CompletionItemKind::Property),
                detail: Some(self.analysis.written(param.span).to_owned()),
                insert_text: Some(format!("{} = ", spelled(&param.name.name))),
                ..CompletionItem::default()
            })
            .collect();
        for item in items {
            self.add(item);
        }
    }

    /// The names that the item at the cursor binds before it.
    fn bound(&mut self) {
        let main = self.analysis.main();
        let items = self.analysis.loaded.ast.items.iter();
        let start = items
            .map(|item| item.span.start)
            .rfind(|start| *start <= self.byte);
        let meanings = &self.analysis.loaded.meanings;
        let bound = meanings.declared().filter(|(span, entity)| {
            let binds = matches!(entity, Entity::Parameter | Entity::Local);
            let here = span.file == main && span.end < self.byte;
            binds && here && start.is_some_and(|start| start <= span.start)
        });
        let bound: Vec<Span> = bound.map(|(span, _)| span).collect();
        for span in bound {
            if let Some(item) = self.item(span) {
                self.add(item);
            }
        }
    }
}

fn kind(entity: Entity) -> CompletionItemKind {
    match entity {
        Entity::World => CompletionItemKind::Module,
        Entity::Place | Entity::Wall | Entity::Robot => CompletionItemKind::Constant,
        Entity::Kind | Entity::Enum => CompletionItemKind::Enum,
        Entity::Sensor => CompletionItemKind::Field,
        Entity::Variant => CompletionItemKind::EnumMember,
        Entity::Input | Entity::State | Entity::Parameter | Entity::Local => {
            CompletionItemKind::Variable
        }
        Entity::Event => CompletionItemKind::Event,
        Entity::Let | Entity::Behavior => CompletionItemKind::Function,
        Entity::Predicate => CompletionItemKind::Property,
        Entity::Tree => CompletionItemKind::Struct,
        Entity::Task | Entity::Learner => CompletionItemKind::Class,
        Entity::Test => CompletionItemKind::Text,
    }
}
