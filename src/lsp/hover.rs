//! What a name is, said in a few lines.

use super::analysis::Analysis;
use super::outline::Outlined;
use super::reference::{self, Form};
use crate::check::{Entity, Meaning};
use crate::source::Span;
use crate::syntax::tokens::Kind;
use gen_lsp_types::{Contents, Hover, MarkupContent, MarkupKind};

/// As many lines of a declaration are shown.
const LINES: usize = 12;

/// What stands at a byte of the main file.
pub(super) fn hover(analysis: &Analysis, byte: u32) -> Option<Hover> {
    let meanings = &analysis.loaded.meanings;
    let (span, text) = match meanings.at(analysis.main(), byte) {
        Some((name, Meaning::Declared(declared))) => (name, described(analysis, name, declared)?),
        Some((name, Meaning::BuiltIn)) => (name, explained(analysis.written(name))?),
        None => word(analysis, byte)?,
    };
    Some(Hover {
        contents: Contents::MarkupContent(markdown(text)),
        range: Some(analysis.range(span)),
    })
}

/// Text with marks for emphasis and code.
pub(super) fn markdown(value: String) -> MarkupContent {
    MarkupContent {
        kind: MarkupKind::Markdown,
        value,
    }
}

/// A word of the language that has no meaning of its own.
fn word(analysis: &Analysis, byte: u32) -> Option<(Span, String)> {
    let byte = byte as usize;
    let at = analysis.tokens.partition_point(|token| token.end < byte);
    let near = analysis.tokens.get(at..)?.iter().take(2);
    let mut words = near.filter(|token| token.kind == Kind::Word && token.start <= byte);
    let token = words.next()?;
    let text = explained(token.of(analysis.text()))?;
    Some((Span::new(analysis.main(), token.start, token.end), text))
}

/// What the language reference says of a word.
pub(super) fn explained(word: &str) -> Option<String> {
    let forms: Vec<&Form> = reference::of(word).collect();
    let mut text = String::new();
    for form in &forms {
        text.push_str(&format!("```bt\n{}\n```\n", form.written));
        if !form.says.is_empty() {
            text.push_str(&format!("{}\n\n", form.says));
        }
    }
    (!forms.is_empty()).then(|| text.trim_end().to_owned())
}

/// What is declared at a place, and of which type the name is that stands for it.
fn described(analysis: &Analysis, name: Span, declared: Span) -> Option<String> {
    let outlines = analysis.outlines();
    let found = outlines.iter().find_map(|outlined| outlined.find(declared));
    let meanings = &analysis.loaded.meanings;
    let ty = meanings
        .type_of(declared)
        .or_else(|| meanings.type_of(name));
    if let Some(text) = of_parameter(analysis, &outlines, declared, ty.as_deref()) {
        return Some(text);
    }
    let mut text = match found {
        Some(found) => of_outlined(analysis, found),
        None => of_bound(analysis, declared, ty.as_deref())?,
    };
    let entity = meanings.entity(declared)?;
    let typed = matches!(entity, Entity::Input | Entity::State | Entity::Let);
    if let Some(ty) = ty.filter(|_| typed) {
        text.push_str(&format!("\n\nIts value is {ty}."));
    }
    let used: Vec<Span> = meanings.uses_of(declared).collect();
    if entity == Entity::Kind {
        let places = used.len();
        text.push_str(&format!(
            " Families range over its members. Used in {places} more places."
        ));
    }
    Some(text)
}

/// A declaration with its documentation, and of a behaviour its regions.
pub(super) fn of_outlined(analysis: &Analysis, found: &Outlined) -> String {
    let mut text = format!("```bt\n{}\n", head(analysis, found));
    for region in found.regions() {
        text.push_str(&format!("    {}\n", analysis.written(region)));
    }
    text.push_str("```");
    if !found.docs.is_empty() {
        text.push_str("\n\n");
        text.push_str(&found.docs.join("\n"));
    }
    text
}

/// A declaration without its block; one without a block whole, unless it is long.
fn head(analysis: &Analysis, found: &Outlined) -> String {
    let written = analysis.written(found.span);
    let block = matches!(
        found.entity,
        Entity::World | Entity::Robot | Entity::Behavior | Entity::Task | Entity::Learner
    );
    if block {
        let head = written.split('{').next().unwrap_or_default();
        return head.trim_end().to_owned();
    }
    if found.entity == Entity::Variant {
        return analysis.written(found.name.span).to_owned();
    }
    let mut lines: Vec<&str> = written.lines().take(LINES).collect();
    if written.lines().count() > LINES {
        lines.push("…");
    }
    lines.join("\n")
}

/// A parameter, as it stands in the head of what has it.
fn of_parameter(
    analysis: &Analysis,
    outlines: &[Outlined],
    declared: Span,
    ty: Option<&str>,
) -> Option<String> {
    outlines.iter().find_map(|outlined| {
        let mut params = outlined.params?.params.iter();
        let param = params.find(|param| param.name.span == declared)?;
        let written = analysis.written(param.span);
        let owner = &outlined.name.name;
        let ty = ty.map_or(String::new(), |ty| format!(", {ty}"));
        Some(format!(
            "```bt\n{written}\n```\n\nA parameter of `{owner}`{ty}."
        ))
    })
}

/// A name that a body binds, or a kind.
fn of_bound(analysis: &Analysis, declared: Span, ty: Option<&str>) -> Option<String> {
    let entity = analysis.loaded.meanings.entity(declared)?;
    let name = analysis.written(declared);
    let (what, said) = match entity {
        Entity::Local => ("name in this body", ty),
        Entity::Kind => ("kind", None),
        _ => return None,
    };
    let written = analysis.loaded.meanings.written_type(declared);
    let head = match written {
        Some(ty) => format!("{name}: {ty}"),
        None => name.to_owned(),
    };
    let said = said.map_or(String::new(), |said| format!(", {said}"));
    Some(format!("```bt\n{head}\n```\n\nA {what}{said}."))
}
