//! What an editor offers above a task, a learner or a tree: learn it, run it, show it.

use super::analysis::Analysis;
use super::documents::Documents;
use super::outline::whole_tree;
use crate::check::learned_name;
use crate::source::Span;
use crate::syntax::ast::{Item, ItemKind, Learn};
use gen_lsp_types::{CodeLens, Command, Uri};
use serde_json::json;

/// Learns with a learner.
const LEARN: &str = "btc.learn";
/// Runs a tree.
const RUN: &str = "btc.run";
/// Shows a tree as a picture.
const SHOW: &str = "btc.showTree";

/// The commands above the items of the main file. They are the editor's, so only those stand there that it has.
pub(super) fn lenses(
    analysis: &Analysis,
    documents: &Documents,
    commands: &[String],
) -> Vec<CodeLens> {
    let Some(path) = analysis.path(analysis.main()) else {
        return Vec::new();
    };
    let mut lenses = Lenses {
        analysis,
        uri: documents.uri(path),
        commands,
        found: Vec::new(),
    };
    for item in &analysis.loaded.ast.items {
        lenses.above(item);
    }
    lenses.found
}

struct Lenses<'a> {
    analysis: &'a Analysis,
    uri: Uri,
    commands: &'a [String],
    found: Vec<CodeLens>,
}

impl<'a> Lenses<'a> {
    fn above(&mut self, item: &Item) {
        match &item.kind {
            ItemKind::Task(task) => {
                let (at, of_task) = (task.name.span, &task.name.name);
                let learners = self.items().filter_map(|item| match &item.kind {
                    ItemKind::Learn(learn) if learn.task.name == *of_task => Some(learn),
                    _ => None,
                });
                let learners: Vec<&str> = learners.map(learned_name).collect();
                let trees = self.items().filter_map(whole_tree);
                let trees = trees.filter(|tree| {
                    let task = tree.task.as_ref();
                    task.is_some_and(|task| task.name == *of_task)
                });
                let trees: Vec<&str> = trees.map(|tree| tree.name.name.as_str()).collect();
                self.learn(at, &learners);
                self.run(at, &trees);
                self.show(at, &trees);
            }
            ItemKind::Learn(learn) => self.learn(name_of(learn), &[learned_name(learn)]),
            ItemKind::Tree(_) => {
                let Some(tree) = whole_tree(item) else { return };
                let (at, name) = (tree.name.span, tree.name.name.as_str());
                if tree.task.is_some() || self.has_one_task() {
                    self.run(at, &[name]);
                }
                self.show(at, &[name]);
            }
            _ => {}
        }
    }

    fn learn(&mut self, at: Span, learners: &[&str]) {
        self.offer(at, LEARN, "Learn", "learner", learners);
    }

    fn run(&mut self, at: Span, trees: &[&str]) {
        self.offer(at, RUN, "Run", "tree", trees);
    }

    fn show(&mut self, at: Span, trees: &[&str]) {
        self.offer(at, SHOW, "Show tree", "tree", trees);
    }

    /// A command for each name; the title says the name where there are several.
    fn offer(&mut self, at: Span, command: &str, title: &str, key: &str, names: &[&str]) {
        if !self.commands.iter().any(|known| known == command) {
            return;
        }
        for &name in names {
            let title = match names {
                [_] => title.to_owned(),
                _ => format!("{title} {name}"),
            };
            let arguments = vec![json!({ "uri": self.uri, key: name })];
            self.found.push(CodeLens {
                range: self.analysis.range(at),
                command: Some(Command {
                    title,
                    tooltip: None,
                    command: command.to_owned(),
                    arguments: Some(arguments),
                }),
                data: None,
            });
        }
    }

    fn items(&self) -> impl Iterator<Item = &'a Item> {
        self.analysis.loaded.ast.items.iter()
    }

    /// Whether a tree needs not say which task it is for.
    fn has_one_task(&self) -> bool {
        let items = self.analysis.loaded.asts().flat_map(|ast| &ast.items);
        let tasks = items.filter(|item| matches!(item.kind, ItemKind::Task(_)));
        tasks.count() == 1
    }
}

/// Where the name of a learner stands, or what it learns if it has none.
fn name_of(learn: &Learn) -> Span {
    let name = learn.name.as_ref();
    name.map_or(learn.task.span, |name| name.span)
}
