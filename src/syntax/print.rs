//! The formatter and the printer, which are one: a syntax tree as text.
//!
//! What is printed parses to the same tree. Four blanks a level; adjacent entries of one kind are aligned in columns;
//! comments stay where they are; a blank line between entries stays, and several become one. Blocks of statements and
//! the branches of an `if` stay on one line if they were written so and fit; lists of arguments and children are
//! broken, one a line, where one line would be too long. Literals keep their spelling.

mod block;
mod broken;
mod columns;
mod flat;
mod item;
mod remarks;
mod task;
mod tree;
mod world;

use super::ast;
use super::parse::parse;
use crate::diagnostic::Diagnostic;
use crate::source::FileId;
use columns::{Group, Line};
use remarks::Remarks;

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
/// printed as a tree that has never been text, its documentation as `///` lines.
pub fn file(file: &ast::File, source: Option<&str>) -> String {
    let mut printer = Printer::new(source.map(|text| Remarks::new(text, &file.comments)));
    printer.items(&file.items);
    printer.finish()
}

/// An item as text, with its documentation, ending in a newline.
pub fn item(item: &ast::Item) -> String {
    let mut printer = Printer::new(None);
    printer.item(item);
    printer.finish()
}

/// A node of a tree as text, without a newline at its end.
pub fn node(node: &ast::Node) -> String {
    let mut printer = Printer::new(None);
    printer.node(node, 0);
    printer.end_line(Group::None);
    printer.finish().trim_end().to_owned()
}

/// An expression as text, on one line.
pub fn expr(expr: &ast::Expr) -> String {
    flat::expr(expr)
}

/// The lines that are printed so far, and the one that is being written.
struct Printer<'a> {
    lines: Vec<Line>,
    /// How many lines of code have been ended.
    ended: usize,
    /// The columns of the present line.
    cells: Vec<String>,
    /// The level at which the next line begins.
    indent: usize,
    /// The level at which the present line has begun.
    begun: Option<usize>,
    /// Whether a blank line goes before the present one.
    blank: bool,
    /// Whether the next entry is the first of its block.
    first: bool,
    /// Where a comment goes that stands inside the present entry, at a place where none can stay.
    entry: usize,
    remarks: Option<Remarks<'a>>,
}

impl<'a> Printer<'a> {
    fn new(remarks: Option<Remarks<'a>>) -> Self {
        Self {
            lines: Vec::new(),
            ended: 0,
            cells: vec![String::new()],
            indent: 0,
            begun: None,
            blank: false,
            first: true,
            entry: 0,
            remarks,
        }
    }

    fn finish(self) -> String {
        columns::text(&self.lines)
    }

    fn write(&mut self, text: &str) {
        self.begun.get_or_insert(self.indent);
        if let Some(cell) = self.cells.last_mut() {
            cell.push_str(text);
        }
    }

    /// Begins the next column of the line.
    fn cell(&mut self, text: &str) {
        self.cells.push(text.to_owned());
    }

    /// The column at which the line stands, were it not aligned.
    fn column(&self) -> usize {
        let text: usize = self.cells.iter().map(|cell| cell.chars().count()).sum();
        4 * self.begun.unwrap_or(self.indent) + text + self.cells.len() - 1
    }

    fn end_line(&mut self, group: Group) {
        self.ended += 1;
        let cells = std::mem::replace(&mut self.cells, vec![String::new()]);
        self.lines.push(Line {
            indent: self.begun.take().unwrap_or(self.indent),
            cells,
            group,
            blank_before: std::mem::take(&mut self.blank),
            comment: None,
        });
    }

    fn open_block(&mut self, group: Group) {
        self.write("{");
        self.end_line(group);
        self.indent += 1;
        self.first = true;
    }

    /// Ends a block, and leaves the line open after its brace.
    fn close_block(&mut self) {
        self.indent -= 1;
        self.first = false;
        self.write("}");
    }
}
