//! Tasks and learners.

use super::Printer;
use super::columns::{Align, KEYS};
use super::doc::{Brackets, Break, Doc, Entry, row};
use super::names::ident;
use crate::source::Span;
use crate::spelling::quoted;
use crate::syntax::ast::{
    Aspect, AspectKind, Expr, Learn, LearnEntry, Outcome, Paid, RewardLine, Setting, Spanned,
    Start, Task,
};
use crate::syntax::words::ASPECTS;

impl Printer<'_> {
    pub(super) fn task<'a>(&self, task: &'a Task, span: Span) -> Doc<'a> {
        let aspects = task.aspects.iter().map(|aspect| self.aspect(aspect));
        let braces = self.braces(task.name.span.range().end, span, aspects.collect());
        row!["task ", ident(&task.name), " ", braces]
    }

    fn aspect<'a>(&self, aspect: &'a Aspect) -> Entry<'a> {
        let in_columns = Align::Of("aspect");
        let (align, doc) = match &aspect.kind {
            AspectKind::Observe(list) => (in_columns, self.list("observe", list, aspect.span)),
            AspectKind::Choose(list) => (in_columns, self.list("choose", list, aspect.span)),
            AspectKind::History { window, outcomes } => {
                let window = self.expr(window).flat();
                let outcomes = joined(outcomes);
                let last = row!["last ", window, " ", outcomes];
                (in_columns, row!["history", Doc::column(), last])
            }
            AspectKind::Patience(value) => (
                in_columns,
                row!["patience", Doc::column(), self.expr(value)],
            ),
            AspectKind::Start(start) => (Align::None, self.start(start)),
            AspectKind::EndOn(value) => (Align::None, row!["end on ", self.expr(value)]),
            AspectKind::EndAfter(value) => (Align::None, row!["end after ", self.expr(value)]),
            AspectKind::Reward { lines, otherwise } => {
                let doc = self.reward(lines, otherwise.as_ref(), aspect.span);
                (Align::None, doc)
            }
            AspectKind::Error => (Align::None, Doc::nothing()),
        };
        Entry::aligned(aspect.span, align, doc)
    }

    /// `observe a, b`; one entry a line where one line cannot hold them.
    fn list<'a>(&self, word: &'static str, list: &'a [Expr], span: Span) -> Doc<'a> {
        let items = list
            .iter()
            .map(|item| Entry::new(item.span, self.list_item(item)))
            .collect();
        let range = span.range();
        let inside = Span::new(span.file, range.start + word.len(), range.end);
        let list = Doc::list(Brackets::NONE, inside, items);
        // Columns may push the list to the right, as far as behind the longest word.
        let room = "patience".len() - word.len();
        row![
            word,
            row![Doc::column(), list]
                .grouped(span, Break::TooLong)
                .room(room)
        ]
    }

    /// An entry of `observe` or `choose`; one that begins with the word of an aspect has that in backquotes.
    fn list_item<'a>(&self, item: &'a Expr) -> Doc<'a> {
        let text = self.expr(item).on_one_line();
        let is_name = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
        let rest = text.trim_start_matches(is_name);
        let word = text.get(..text.len() - rest.len()).unwrap_or_default();
        if ASPECTS.contains(&word) && !rest.starts_with('(') {
            Doc::from(quoted(word) + rest)
        } else {
            Doc::from(text)
        }
    }

    fn start<'a>(&self, start: &'a Start) -> Doc<'a> {
        let lines = start.lines.iter().map(|line| {
            let doc = self.definition(self.call(&line.target).flat(), &line.value);
            Entry::aligned(line.span, Align::Of("start"), doc)
        });
        let braces = self.braces(start.span.range().start, start.span, lines.collect());
        row!["start ", braces]
    }

    fn reward<'a>(
        &self,
        lines: &'a [RewardLine],
        otherwise: Option<&'a Expr>,
        span: Span,
    ) -> Doc<'a> {
        let entry = |span, head, value| {
            let doc = row![head, ":", Doc::column(), self.expr(value)];
            Entry::aligned(span, Align::Of(KEYS), doc)
        };
        let mut entries: Vec<Entry<'a>> = lines
            .iter()
            .map(|line| {
                let head = match &line.paid {
                    Paid::On(event) => row!["on ", self.expr(event).flat()],
                    Paid::Per { during, time } => {
                        let per = row!["per ", self.expr(time).flat()];
                        match during {
                            Some(during) => row!["while ", self.expr(during).flat(), ", ", per],
                            None => per,
                        }
                    }
                };
                entry(line.span, head, &line.value)
            })
            .collect();
        entries.extend(otherwise.map(|value| {
            let word = "otherwise";
            let source = self.source;
            let span = source.map_or(value.span, |source| source.word_before(word, value.span));
            entry(span, Doc::from(word), value)
        }));
        row!["reward ", self.braces(span.range().start, span, entries)]
    }

    pub(super) fn learn<'a>(&self, learn: &'a Learn, span: Span) -> Doc<'a> {
        let name = match &learn.name {
            Some(name) => row![ident(name), " for "],
            None => Doc::nothing(),
        };
        let entries = learn.entries.iter().filter_map(|entry| match entry {
            LearnEntry::Start(start) => Some(Entry::new(start.span, self.start(start))),
            LearnEntry::Setting(setting) => Some(self.setting(setting)),
            LearnEntry::Error(_) => None,
        });
        let braces = self.braces(learn.task.span.range().end, span, entries.collect());
        row!["learn ", name, ident(&learn.task), " ", braces]
    }

    fn setting<'a>(&self, setting: &'a Setting) -> Entry<'a> {
        let tail = match &setting.tail {
            Some((link, value)) => row![" ", link.node.spelling(), " ", self.expr(value)],
            None => Doc::nothing(),
        };
        let value = self.expr(&setting.value).room(tail.width);
        let doc = row![ident(&setting.name), Doc::column(), "= ", value, tail];
        Entry::aligned(setting.span, Align::Of("setting"), doc)
    }
}

fn joined(outcomes: &[Spanned<Outcome>]) -> String {
    let words: Vec<&str> = outcomes
        .iter()
        .map(|outcome| outcome.node.spelling())
        .collect();
    words.join(", ")
}
