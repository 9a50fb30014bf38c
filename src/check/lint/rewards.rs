//! Rewards that are never paid, ends that count for nothing, and times that never pass.

use super::cases::{Cases, of_expr};
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::ExprId;
use crate::ir::task::Task;
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{self, AspectKind, Expr, Item, ItemKind, LearnEntry, RewardLine};

impl<'a> Checker<'a> {
    /// Warns of what a task says about rewards, ends and times without any effect.
    pub fn rewards_without_effect(&mut self, items: impl Iterator<Item = &'a Item>) {
        for item in items {
            match &item.kind {
                ItemKind::Task(task) => {
                    let name = Name::word(&task.name.name);
                    if let Some(id) = self.program.tasks.find(|task| task.name == name) {
                        self.rewards_of(task, id);
                    }
                }
                ItemKind::Learn(learn) => self.dwells_too_long(learn),
                _ => {}
            }
        }
    }

    fn rewards_of(&mut self, task: &'a ast::Task, id: Id<Task>) {
        let checked = self.program.tasks[id].clone();
        let mut ends = checked.end_on.iter();
        for aspect in &task.aspects {
            match &aspect.kind {
                AspectKind::Reward { lines, otherwise } => {
                    self.lines_without_effect(lines, &checked);
                    let values = checked.reward.iter().map(|line| line.value);
                    let mut values = values.chain([checked.otherwise]);
                    let zero = |id: ExprId| self.program.pool.constant(id) == Some(0.0);
                    if values.all(zero) {
                        let last = otherwise.as_ref().or(lines.last().map(|line| &line.value));
                        let span = last.map_or(aspect.span, |value| value.span);
                        self.warning(Code::W0510, span, "every reward of this task is 0")
                            .label("so any tree is as good as any other");
                    }
                }
                AspectKind::EndOn(event) => {
                    if let Some(&end) = ends.next() {
                        self.end_without_value(event, end, &checked);
                    }
                }
                AspectKind::Patience(time)
                    if checked
                        .patience
                        .is_some_and(|ticks| ticks >= checked.end_after) =>
                {
                    self.warning(Code::W0512, time.span, "no episode lasts so long")
                        .label("so patience never runs out")
                        .note(format!("an episode ends after {} ticks", checked.end_after));
                }
                _ => {}
            }
        }
    }

    /// The first line whose event happens gives the reward.
    fn lines_without_effect(&mut self, lines: &'a [RewardLine], checked: &Task) {
        let mut before: Vec<(Span, Cases)> = Vec::new();
        for (line, checked) in lines.iter().zip(&checked.reward) {
            let here = line.event.span;
            let cases = of_expr(&self.program, checked.event, true);
            let earlier = before.iter().find(|(_, earlier)| cases.implies(earlier));
            if cases.is_never() {
                self.warning(Code::W0509, here, "this reward is never paid")
                    .label("this never happens");
            } else if let Some((earlier, _)) = earlier {
                let earlier = *earlier;
                self.warning(Code::W0509, here, "this reward is never paid")
                    .label("whenever this happens, an earlier line pays")
                    .also(earlier, "this line comes first");
            }
            before.push((here, cases));
        }
    }

    fn end_without_value(&mut self, event: &'a Expr, end: ExprId, checked: &Task) {
        let end = of_expr(&self.program, end, true);
        if end.is_never() {
            self.warning(Code::W0509, event.span, "no episode ends on this")
                .label("this never happens");
            return;
        }
        let rewarded = checked.reward.iter().any(|line| {
            let paid = of_expr(&self.program, line.event, true);
            !end.and(&paid).is_never() && (end.implies(&paid) || paid.implies(&end))
        });
        if !rewarded {
            self.warning(Code::W0511, event.span, "this end is neither good nor bad")
                .label("no line of `reward` says what it is worth")
                .help("reward it, or make it cost something, such as `on EVENT: -5`");
        }
    }

    fn dwells_too_long(&mut self, learn: &'a ast::Learn) {
        let name = crate::check::names::learned_name(learn);
        let mut learners = self.program.learners.values();
        let learner = learners.find(|learner| learner.name.is(name));
        let Some((dwell, episode)) = learner.map(|learner| (learner.dwell, learner.episode_ticks))
        else {
            return;
        };
        let setting = learn.entries.iter().find_map(|entry| match entry {
            LearnEntry::Setting(setting) if setting.name.name == "dwell" => Some(setting),
            _ => None,
        });
        if let Some(setting) = setting.filter(|_| dwell >= episode) {
            self.warning(Code::W0512, setting.value.span, "no episode lasts so long")
                .label("so there is one decision in each episode")
                .note(format!("an episode of learning ends after {episode} ticks"));
        }
    }
}
