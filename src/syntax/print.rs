//! The formatter and the printer, which are one: a syntax tree as text.
//!
//! What is printed parses to the same tree. Four blanks a level; adjacent entries of one kind are aligned in columns;
//! comments stay where they are; a blank line between entries stays, and several become one. Blocks of statements and
//! the branches of an `if` stay on one line if they were written so and fit; lists of arguments and children are
//! broken, one a line, where one line would be too long. Literals keep their spelling.
//!
//! A tree becomes text in three steps. The files named after constructs turn each into a document (`doc`), which
//! says where it may be broken. The layout breaks the document into lines, and puts the comments of the source among
//! them. At last adjacent lines are brought into columns.

mod block;
mod columns;
mod doc;
mod expr;
mod item;
mod layout;
mod levels;
mod list;
mod names;
mod remarks;
mod source;
mod task;
mod test;
mod tree;
mod world;

use super::ast;
use super::parse::parse;
use crate::diagnostic::Diagnostic;
use crate::source::FileId;
use doc::Entry;
use layout::Layout;
use source::Source;

/// The column that a line of code does not pass if it can be broken.
const WIDTH: usize = 110;

/// The formatted text of a file.
///
/// # Errors
/// A text that does not parse is not formatted: the diagnostics say why.
pub fn format(text: &str) -> Result<String, Vec<Diagnostic>> {
    let (tree, diagnostics) = parse(FileId(0), text);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return Err(diagnostics);
    }
    Ok(file(&tree, Some(text)))
}

/// A file as text. With the `source` that it was parsed from, its comments and blank lines stay; without, it is
/// printed as a tree that has never been text, its documentation as `///` lines, whatever its spans are.
pub fn file(file: &ast::File, source: Option<&str>) -> String {
    let source = source.map(Source::new);
    let printer = Printer {
        source: source.as_ref(),
        stands: None,
    };
    let items = printer.items(&file.items);
    let text = Layout::new(source.as_ref(), &file.comments).text(&items);
    match source {
        Some(source) if source.ends_in_carriage_returns() => text.replace('\n', "\r\n"),
        _ => text,
    }
}

/// An item as text, with its documentation, ending in a newline.
pub fn item(item: &ast::Item) -> String {
    let item = Printer::default().item(item);
    Layout::new(None, &[]).text(&[item])
}

/// A node of a tree as text, without a newline at its end.
pub fn node(node: &ast::Node) -> String {
    let doc = Printer::default().node(node);
    let text = Layout::new(None, &[]).text(&[Entry::new(node.span, doc)]);
    text.trim_end().to_owned()
}

/// An expression as text, on one line.
pub fn expr(expr: &ast::Expr) -> String {
    Printer::default().expr(expr).on_one_line()
}

/// An expression as text, on one line, in which other text stands for some of its names.
pub fn expr_with(expr: &ast::Expr, stands: &Stands) -> String {
    let printer = Printer {
        stands: Some(stands),
        ..Printer::default()
    };
    printer.expr(expr).on_one_line()
}

/// An argument as text, on one line.
pub fn argument(arg: &ast::Arg) -> String {
    Printer::default().arg(arg).on_one_line()
}

/// The text that stands for a name, if another does.
pub type Stands<'s> = dyn Fn(&str) -> Option<String> + 's;

/// Turns syntax into documents.
#[derive(Clone, Copy, Default)]
struct Printer<'s> {
    /// What the tree was parsed from.
    source: Option<&'s Source<'s>>,
    /// The text that stands for a name.
    stands: Option<&'s Stands<'s>>,
}
