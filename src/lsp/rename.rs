//! Renaming, checked: the programs mean afterwards what they meant before.

use super::Workspace;
use super::analysis::Analysis;
use super::documents::{Document, Documents};
use super::navigate::{Declared, named};
use crate::check::Meaning;
use crate::source::Span;
use crate::spelling::{RESERVED, bare, spelled, unusable};
use crate::syntax::Memory;
use gen_lsp_types::{TextEdit, Uri, WorkspaceEdit};
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// The edits that give a declaration another name in all programs.
///
/// # Errors
/// Why it cannot be called so.
pub(super) fn rename(
    programs: &[Rc<Analysis>],
    documents: &Documents,
    workspace: &dyn Workspace,
    declared: &Declared,
    new_name: &str,
) -> Result<WorkspaceEdit, String> {
    let old = &declared.name;
    if declared.path.is_none() {
        return Err(format!("`{old}` is of the standard library"));
    }
    let new = bare(new_name);
    if let Some(why) = unusable(new) {
        return Err(why.to_owned());
    }
    if RESERVED.contains(&new) && !new_name.contains('`') {
        return Err(format!("`{new}` is a word of the language, not a name"));
    }
    let new_text = spelled(new).into_owned();
    let mut changes: HashMap<Uri, Vec<TextEdit>> = HashMap::new();
    let mut texts: BTreeMap<String, String> = BTreeMap::new();
    for program in programs {
        let Some(at) = declared.in_program(program) else {
            continue;
        };
        let edits: Vec<(Span, String)> = (named(program, at).into_iter())
            .map(|span| (span, new_text.clone()))
            .collect();
        for (span, new_text) in &edits {
            let Some(location) = program.location(*span, documents) else {
                return Err(format!("`{old}` is used where it cannot be renamed"));
            };
            let edit = TextEdit {
                range: location.range,
                new_text: new_text.clone(),
            };
            let file = changes.entry(location.uri).or_default();
            if !file.contains(&edit) {
                file.push(edit);
            }
        }
        let named = program.loaded.texts(&edits);
        texts.extend(named.into_values().map(|source| (source.name, source.text)));
    }
    for program in programs {
        same_meaning(program, &texts, documents, workspace, old, &new_text)?;
    }
    for edits in changes.values_mut() {
        edits.sort_by_key(|edit| edit.range);
    }
    Ok(WorkspaceEdit {
        changes: Some(changes),
        ..WorkspaceEdit::default()
    })
}

/// Whether a program means with new texts what it meant: it has no new mistake, and its names stand for the same.
fn same_meaning(
    program: &Analysis,
    texts: &BTreeMap<String, String>,
    documents: &Documents,
    workspace: &dyn Workspace,
    old: &str,
    new: &str,
) -> Result<(), String> {
    let path = program.path(program.main()).unwrap_or_default();
    let text = texts.get(path).map_or(program.text(), String::as_str);
    let mut renamed = Documents::default();
    for (path, document) in &documents.open {
        let copy = Document::new(document.uri.clone(), 0, document.text.clone());
        renamed.open.insert(path.clone(), copy);
    }
    for (path, text) in texts {
        let file = Document::new(documents.uri(path), 0, text.clone());
        renamed.open.insert(path.clone(), file);
    }
    let memory = &mut Memory::default();
    let after = Analysis::of(path, text.to_owned(), &renamed, workspace, memory);
    let errors = |analysis: &Analysis| {
        let found = analysis.loaded.diagnostics.iter();
        found.filter(|found| found.is_error()).count()
    };
    if errors(&after) > errors(program) {
        let before: Vec<_> = program
            .loaded
            .diagnostics
            .iter()
            .map(|it| it.code)
            .collect();
        let mut found = after.loaded.diagnostics.iter().filter(|it| it.is_error());
        let why = found.find(|found| !before.contains(&found.code));
        let why = why.map_or(String::new(), |found| format!(": {}", found.message));
        return Err(format!(
            "`{old}` cannot be called `{}` here{why}",
            bare(new)
        ));
    }
    if shape(&after) != shape(program) {
        return Err(format!(
            "called `{}`, `{old}` would be taken for something else, or something else for it",
            bare(new)
        ));
    }
    Ok(())
}

/// Which name stands for which declaration, names and declarations by their order in their files.
fn shape(analysis: &Analysis) -> Vec<(usize, Option<usize>)> {
    let meanings = &analysis.loaded.meanings;
    let mut places: Vec<Span> = meanings.declared().map(|(span, _)| span).collect();
    places.extend(meanings.uses().map(|(span, _)| span));
    places.sort();
    places.dedup();
    let order = |span: Span| places.binary_search(&span).unwrap_or(usize::MAX);
    let uses = meanings.uses().map(|(span, meaning)| match meaning {
        Meaning::Declared(declared) => (order(span), Some(order(declared))),
        Meaning::BuiltIn => (order(span), None),
    });
    uses.collect()
}
