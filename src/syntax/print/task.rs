//! Tasks and learners.

use super::columns::Group;
use super::{Printer, WIDTH, flat};
use crate::source::Span;
use crate::syntax::ast::{
    Aspect, AspectKind, Expr, Learn, LearnEntry, RewardLine, Setting, Start, Task,
};

impl Printer<'_> {
    pub(super) fn task(&mut self, task: &Task, span: Span) {
        self.write(&format!("task {} ", flat::ident(&task.name)));
        self.begin_braces(task.name.span.range().end);
        for aspect in &task.aspects {
            self.entry(aspect.span, |printer| printer.aspect(aspect));
        }
        self.end_braces(span.range().end, task.aspects.is_empty());
    }

    fn aspect(&mut self, aspect: &Aspect) {
        match &aspect.kind {
            AspectKind::Observe(list) => self.list("observe", list, aspect.span),
            AspectKind::Choose(list) => self.list("choose", list, aspect.span),
            AspectKind::History { window, outcomes } => {
                let outcomes = outcomes
                    .iter()
                    .map(|outcome| flat::outcome(outcome.node).to_owned());
                self.write("history");
                self.cell(&format!(
                    "last {} {}",
                    flat::expr(window),
                    flat::joined(outcomes)
                ));
                self.end_line(Group::Of("aspect"));
            }
            AspectKind::Patience(value) => {
                self.write("patience");
                self.cell("");
                self.value("aspect", value);
            }
            AspectKind::Start(start) => self.start(start),
            AspectKind::EndOn(value) => self.worded("end on ", value),
            AspectKind::EndAfter(value) => self.worded("end after ", value),
            AspectKind::Reward { lines, otherwise } => {
                self.reward(lines, otherwise.as_ref(), aspect.span)
            }
            AspectKind::Error => self.end_line(Group::None),
        }
    }

    /// `observe a, b`; one entry a line where one line cannot hold them.
    fn list(&mut self, word: &str, list: &[Expr], span: Span) {
        self.write(word);
        let text = flat::joined(list.iter().map(flat::list_item));
        // Columns may push the list a little to the right.
        if !self.has_comment(span)
            && 4 * self.indent + "patience ".len() + text.chars().count() <= WIDTH
        {
            self.cell(&text);
            self.end_line(Group::Of("aspect"));
            return;
        }
        self.end_line(Group::None);
        self.trailing(span.range().start + word.len());
        self.indent += 1;
        self.first = true;
        for item in list {
            self.entry(item.span, |printer| {
                printer.write(&flat::list_item(item));
                printer.write(",");
                printer.end_line(Group::None);
            });
        }
        self.rest_of_block(span.range().end);
        self.indent -= 1;
        self.first = false;
    }

    pub(super) fn start(&mut self, start: &Start) {
        self.write("start ");
        self.begin_braces(start.span.range().start);
        for line in &start.lines {
            self.entry(line.span, |printer| {
                printer.definition("start", &flat::reference(&line.target), &line.value);
            });
        }
        self.end_braces(start.span.range().end, start.lines.is_empty());
    }

    fn reward(&mut self, lines: &[RewardLine], otherwise: Option<&Expr>, span: Span) {
        self.write("reward ");
        self.begin_braces(span.range().start);
        for line in lines {
            self.entry(line.span, |printer| {
                printer.write(&format!("on {}:", flat::expr(&line.event)));
                printer.cell("");
                printer.value("reward", &line.value);
            });
        }
        if let Some(value) = otherwise {
            self.entry(self.word_before("otherwise", value.span), |printer| {
                printer.write("otherwise:");
                printer.cell("");
                printer.value("reward", value);
            });
        }
        self.end_braces(span.range().end, lines.is_empty() && otherwise.is_none());
    }

    pub(super) fn learn(&mut self, learn: &Learn, span: Span) {
        let name = learn
            .name
            .as_ref()
            .map_or(String::new(), |name| format!("{} for ", flat::ident(name)));
        self.write(&format!("learn {name}{} ", flat::ident(&learn.task)));
        self.begin_braces(learn.task.span.range().end);
        for entry in &learn.entries {
            match entry {
                LearnEntry::Start(start) => self.entry(start.span, |printer| printer.start(start)),
                LearnEntry::Setting(setting) => {
                    self.entry(setting.span, |printer| printer.setting(setting))
                }
                LearnEntry::Error(_) => {}
            }
        }
        self.end_braces(span.range().end, learn.entries.is_empty());
    }

    fn setting(&mut self, setting: &Setting) {
        let before = self.ended;
        self.write(&flat::ident(&setting.name));
        self.cell("= ");
        let tail = setting
            .tail
            .as_ref()
            .map(|(link, value)| (flat::link(link.node), value));
        let after = tail.map_or(0, |(link, value)| {
            link.len() + flat::expr(value).chars().count() + 2
        });
        self.expr(&setting.value, after);
        if let Some((link, value)) = tail {
            self.write(&format!(" {link} "));
            self.expr(value, 0);
        }
        self.end_entry("setting", before);
    }
}
