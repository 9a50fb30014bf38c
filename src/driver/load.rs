//! A program with everything that it uses.

mod again;

use super::digest::sha256;
use super::text::{Text, decode};
use crate::check::{self, Input, Meanings};
use crate::diagnostic::{self, Applicability, Code, Diagnostic, render, suggest};
use crate::ir::Program;
use crate::source::{FileId, Source, Sources, Span};
use crate::syntax;
use crate::syntax::ast::{self, ItemKind, Spanned, UseWhat};
use std::collections::BTreeMap;

/// The text of the embedded library.
pub const LIBRARY: &str = include_str!("../library/std.bt");

/// The name of the library in diagnostics.
const LIBRARY_NAME: &str = "std";

/// The most bytes of a program, with all that it uses.
pub const MOST: usize = 1_000_000;

/// The most characters that are not seen that are told of a file.
const UNSEEN: usize = 100;

/// The mistake of a program that is larger.
pub(super) fn too_large(at: Span) -> Diagnostic {
    let message = format!("a program has at most {} MB of text", MOST / 1_000_000);
    Diagnostic::new(Code::E0132, at, message)
}

/// Where the files of a program come from.
pub trait Reader {
    /// The bytes of the file at a path.
    ///
    /// # Errors
    /// The reason of the system that it cannot be read.
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String>;

    /// Whether there is a file at a path, where others may have it instead, see [`Reader::roots`].
    fn has(&self, _path: &str) -> bool {
        true
    }

    /// Folders in which a file is looked for that is not where its path leads.
    fn roots(&self) -> Vec<String> {
        Vec::new()
    }
}

/// A loaded and checked program.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// Every file.
    pub sources: Sources,
    /// The file that was asked for.
    pub main: FileId,
    /// Its syntax tree.
    pub ast: ast::File,
    /// The program; usable only without errors.
    pub program: Program,
    /// The files of the user's program in the order of their first use, the main file last.
    pub files: Vec<FileId>,
    /// The tables that the main file names as the environment of its proofs, with the place of the `use`.
    pub tables: Vec<(FileId, Span)>,
    /// Where the values of the program's tunables stand, a list for each.
    pub tunes: Vec<Vec<Span>>,
    /// What the names of the text stand for.
    pub meanings: Meanings,
    /// Every mistake and warning, sorted.
    pub diagnostics: Vec<Diagnostic>,
    /// The files that the main file uses, used files first.
    pub(super) used: Vec<Parsed>,
}

impl Loaded {
    /// Whether there is any error.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// The syntax trees of all files of the program, the main one first.
    pub fn asts(&self) -> impl Iterator<Item = &ast::File> {
        let used = self.used.iter().map(|parsed| &parsed.ast);
        std::iter::once(&self.ast).chain(used)
    }

    /// The files with edits, by id; edits do not overlap.
    pub fn texts(&self, edits: &[(Span, String)]) -> BTreeMap<FileId, Source> {
        let mut texts: BTreeMap<FileId, String> = BTreeMap::new();
        let mut edits = edits.to_vec();
        // From the end, so that places before stay what they are; of several insertions at one place the first stands first.
        edits.sort_by_key(|(span, _)| *span);
        for (span, new) in edits.iter().rev() {
            let Some(source) = self.sources.get(span.file) else {
                continue;
            };
            let text = texts
                .entry(span.file)
                .or_insert_with(|| source.text.clone());
            if text.get(span.range()).is_some() {
                text.replace_range(span.range(), new);
            }
        }
        let named = texts.into_iter().filter_map(|(id, text)| {
            let source = self.sources.get(id)?;
            Some((id, Source::new(source.name.clone(), text)))
        });
        named.collect()
    }

    fn inputs(&self) -> Vec<Input<'_>> {
        let main = Input {
            ast: &self.ast,
            library: false,
        };
        self.used.iter().map(Parsed::input).chain([main]).collect()
    }
}

/// Loads and checks the program in `text`, which is called `name` and whose `use`s are relative to it.
pub fn load(name: &str, text: Vec<u8>, reader: &mut dyn Reader) -> Loaded {
    load_again(name, text, reader, &mut syntax::Memory::default())
}

/// The same of a program whose files may have been parsed before.
pub fn load_again(
    name: &str,
    text: Vec<u8>,
    reader: &mut dyn Reader,
    memory: &mut syntax::Memory,
) -> Loaded {
    let mut loader = Loader {
        reader,
        memory,
        sources: Sources::default(),
        parsed: Vec::new(),
        known: Vec::new(),
        open: Vec::new(),
        tables: Vec::new(),
        diagnostics: Vec::new(),
        depth: 0,
        bytes: text.len(),
        incomplete: false,
    };
    let main = match text.len() > MOST {
        false => loader.file(name, &text, false),
        true => {
            let main = loader.file(name, b"", false);
            let start = Span::new(main, 0, 0);
            let mistake = too_large(start).label("this file alone has more");
            loader.diagnostics.push(mistake);
            main
        }
    };
    let inputs: Vec<Input> = loader.parsed.iter().map(Parsed::input).collect();
    let checked = check::check(&inputs);
    let mut diagnostics = loader.diagnostics;
    // A missing file may declare what seems undeclared.
    let elsewhere = |found: &Diagnostic| match found.code {
        Code::E0202 => !is_slip(&loader.sources, found),
        Code::E0407 => true,
        _ => false,
    };
    // What is found where a text was not understood follows from that, and so may a setting that seems missing there.
    let understood: Vec<&ast::File> = loader.parsed.iter().map(|parsed| &parsed.ast).collect();
    let unread = |found: &Diagnostic| follows(&understood, found);
    let found = checked.diagnostics.into_iter();
    diagnostics
        .extend(found.filter(|found| !(loader.incomplete && elsewhere(found) || unread(found))));
    diagnostic::sort(&mut diagnostics);
    let user = loader.parsed.iter().filter(|parsed| !parsed.library);
    let files = user.map(|parsed| parsed.file).collect();
    // The main file is read to its end after all that it uses.
    let ast = loader.parsed.pop().map(|parsed| parsed.ast);
    let ast = ast.unwrap_or_default();
    Loaded {
        sources: loader.sources,
        main,
        ast,
        program: checked.program,
        files,
        tables: loader.tables,
        tunes: checked.tunes,
        meanings: checked.meanings,
        diagnostics,
        used: loader.parsed,
    }
}

/// Whether an undeclared name is one letter away from one that is known: whatever a missing file declares, that one was meant.
fn is_slip(sources: &Sources, found: &Diagnostic) -> bool {
    let written = sources.text(found.span());
    let mut edits = found.fixes.iter().flat_map(|fix| &fix.edits);
    edits.any(|(span, right)| *span == found.span() && suggest::is_slip(written, right))
}

/// Whether a mistake stands where a text was not understood, or misses something in an item with such a text.
fn follows(asts: &[&ast::File], found: &Diagnostic) -> bool {
    let at = found.span();
    let Some(ast) = asts.iter().find(|ast| ast.span.file == at.file) else {
        return false;
    };
    let touches =
        |one: Span, other: Span| one.start < other.end && other.start < one.end.max(one.start + 1);
    let places = &ast.lost.places;
    if places.iter().any(|place| touches(at, *place)) {
        return true;
    }
    let misses = matches!(found.code, Code::E0402 | Code::E0502);
    let item = || ast.items.iter().find(|item| touches(at, item.span));
    misses && item().is_some_and(|item| places.iter().any(|place| touches(*place, item.span)))
}

/// A file that was read.
#[derive(Clone, Debug)]
pub struct Parsed {
    file: FileId,
    ast: ast::File,
    library: bool,
}

impl Parsed {
    fn input(&self) -> Input<'_> {
        Input {
            ast: &self.ast,
            library: self.library,
        }
    }
}

struct Loader<'r> {
    reader: &'r mut dyn Reader,
    /// The files that were parsed before.
    memory: &'r mut syntax::Memory,
    sources: Sources,
    /// Used files before those that use them.
    parsed: Vec<Parsed>,
    known: Vec<String>,
    /// The files that are being read within one another.
    open: Vec<String>,
    tables: Vec<(FileId, Span)>,
    diagnostics: Vec<Diagnostic>,
    depth: usize,
    /// The bytes of all files but tables so far.
    bytes: usize,
    /// Whether a program that is used cannot be read, or something without a name was not understood.
    incomplete: bool,
}

impl Loader<'_> {
    fn file(&mut self, name: &str, bytes: &[u8], library: bool) -> FileId {
        self.known.push(beside("", name));
        self.open.push(beside("", name));
        let (file, mistake) = decode(&mut self.sources, Text { name, bytes });
        let broken = mistake.is_some();
        self.diagnostics.extend(mistake);
        let text = self.sources.get(file).map(|source| source.text.clone());
        let (ast, mistakes) = self
            .memory
            .parse(name, file, text.as_deref().unwrap_or_default());
        if !broken {
            self.diagnostics.extend(mistakes);
        }
        if !library && !broken {
            let hidden = unseen(file, text.as_deref().unwrap_or_default());
            let hidden = hidden.take(UNSEEN);
            let hidden: Vec<Diagnostic> = hidden.filter(|found| !self.is_told(found)).collect();
            self.diagnostics.extend(hidden);
        }
        self.incomplete |= ast.lost.unnamed;
        self.depth += 1;
        for item in &ast.items {
            if let ItemKind::Use(used) = &item.kind {
                match &used.what.node {
                    UseWhat::Std => self.library(),
                    UseWhat::Path(path) => {
                        self.used(name, path, used.what.span, used.pin.as_ref());
                    }
                }
            }
        }
        self.depth -= 1;
        self.open.pop();
        self.parsed.push(Parsed { file, ast, library });
        file
    }

    /// Whether something else is told of the same place.
    fn is_told(&self, found: &Diagnostic) -> bool {
        let at = found.span();
        let touches =
            |other: Span| other.file == at.file && other.start < at.end && at.start < other.end;
        self.diagnostics.iter().any(|other| touches(other.span()))
    }

    fn library(&mut self) {
        if !self.known.iter().any(|known| known == LIBRARY_NAME) {
            self.file(LIBRARY_NAME, LIBRARY.as_bytes(), true);
        }
    }

    /// The path of a file that `from` uses: beside it or else, of a path that leads down, below the first root that has it.
    fn found(&self, from: &str, path: &str) -> String {
        let resolved = beside(from, path);
        let leads_down = !path.starts_with('/') && path.split('/').all(|part| part != "..");
        if !leads_down || self.known.contains(&resolved) || self.reader.has(&resolved) {
            return resolved;
        }
        let roots = self.reader.roots().into_iter();
        let mut below = roots.map(|root| beside(&format!("{root}/"), path));
        below.find(|path| self.reader.has(path)).unwrap_or(resolved)
    }

    fn used(&mut self, from: &str, path: &str, span: Span, pin: Option<&Spanned<String>>) {
        let resolved = self.found(from, path);
        let table = path.ends_with(".csv");
        if self.open.contains(&resolved) {
            self.incomplete = true;
            let message = format!("`{path}` uses this file, or is this file");
            self.diagnostics.push(
                Diagnostic::new(Code::E0210, span, message)
                    .label("this closes the circle")
                    .help("put what both need into a third file"),
            );
            return;
        }
        if self.known.contains(&resolved) && !table {
            return;
        }
        if matches!(resolved.rsplit('/').next(), Some("" | "." | "..")) {
            self.incomplete = true;
            let message = format!("`{path}` is a folder, not a file");
            let diagnostic = Diagnostic::new(Code::E0208, span, message)
                .label("a file is named by its path, such as \"world.bt\"");
            self.diagnostics.push(diagnostic);
            return;
        }
        let read = self.reader.read(&resolved);
        if let (Ok(bytes), Some(pin)) = (&read, pin) {
            self.diagnostics.extend(unlike(path, bytes, pin));
        }
        match read {
            Ok(bytes) if table => {
                let text = Text {
                    name: &resolved,
                    bytes: &bytes,
                };
                let (file, mistake) = decode(&mut self.sources, text);
                self.diagnostics.extend(mistake);
                if self.depth == 1 {
                    self.tables.push((file, span));
                }
            }
            Ok(bytes) if self.bytes + bytes.len() > MOST => {
                self.incomplete = true;
                let label = "with this file it has more";
                self.diagnostics.push(too_large(span).label(label));
            }
            Ok(bytes) => {
                self.bytes += bytes.len();
                self.file(&resolved, &bytes, false);
            }
            Err(why) => {
                self.incomplete |= !table;
                let mut diagnostic =
                    Diagnostic::new(Code::E0208, span, format!("`{path}` cannot be read"))
                        .label(why)
                        .note(format!("looked for at {resolved}"));
                if matches!(path, "std" | "std.bt") {
                    let title = "the library is no file: `use std`";
                    diagnostic = diagnostic.fix(title, span, "std", Applicability::Unsafe);
                }
                self.diagnostics.push(diagnostic);
            }
        }
    }
}

/// The characters of a text that nobody sees or that turn the direction of writing: the first of each line.
fn unseen(file: FileId, text: &str) -> impl Iterator<Item = Diagnostic> {
    let mut line = 0..0;
    render::hidden(text).filter_map(move |(at, letter)| {
        if line.contains(&at) {
            return None;
        }
        let rest = text.get(at..).unwrap_or_default();
        line = at..at + rest.find('\n').unwrap_or(rest.len());
        let code = u32::from(letter);
        let message = format!("a character that is not seen, U+{code:04X}");
        let span = Span::new(file, at, at + letter.len_utf8());
        let label = match letter.is_control() {
            true => "a terminal would take this for a command",
            false => "this may turn the order in which the line is shown",
        };
        Some(Diagnostic::new(Code::W0101, span, message).label(label))
    })
}

/// The mistake in the hash that a `use` gives, if the file has another.
fn unlike(path: &str, bytes: &[u8], pin: &Spanned<String>) -> Option<Diagnostic> {
    let hash = sha256(bytes);
    (hash != pin.node).then(|| {
        let message = format!("`{path}` is not the file that is named here");
        Diagnostic::new(Code::E0211, pin.span, message)
            .label("its SHA-256 is another")
            .note(format!("it is {hash}: the file was edited, or comes from another run"))
            .help("learn again; or drop `sha256:…` if the change is meant, but then nothing is proved of it yet")
    })
}

/// The path of a file that `from` names: relative to the folder of `from`, `.` and `..` taken out where they can be.
pub fn beside(from: &str, path: &str) -> String {
    let from = if path.starts_with('/') { "/" } else { from };
    let folder = from.rsplit_once('/').map_or("", |(folder, _)| folder);
    let rooted = from.starts_with('/');
    let mut parts: Vec<&str> = Vec::new();
    for part in folder.split('/').chain(path.split('/')) {
        match part {
            "" | "." => {}
            ".." => match parts.last() {
                Some(&last) if last != ".." => {
                    parts.pop();
                }
                _ if rooted => {}
                _ => parts.push(".."),
            },
            other => parts.push(other),
        }
    }
    let joined = parts.join("/");
    if rooted { format!("/{joined}") } else { joined }
}
