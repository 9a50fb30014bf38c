//! Settings of learners with which little or nothing is learned.

use super::interval::Interval;
use super::ranges::range;
use super::view::View;
use crate::check::Checker;
use crate::check::task::schedule;
use crate::diagnostic::{Applicability, Code};
use crate::ir::Name;
use crate::ir::task::{Discount, Learner, Objective};
use crate::math;
use crate::syntax::ast::{self, Item, ItemKind, LearnEntry};
use crate::syntax::print;

/// A discount is hardly less where it says what is left.
const SMALL: f64 = 0.3;

/// Of an episode's time, what comes after so small a part of it is to count for something.
const SHORT: f64 = 50.0;

/// Whoever learns from fewer episodes than this learns next to nothing.
const FEW: u64 = 10;

/// Episodes of learning that are shorter than those of the task by so many times leave out most of it.
const PART: u64 = 50;

/// Less than this share for what is tried is next to nothing.
const SELDOM: f64 = 0.01;

/// A discount looks next to nowhere that leaves a third after so many ticks, and after so many seconds.
const AHEAD: f64 = 20.0;
const SOON: f64 = 2.0;

impl<'a> Checker<'a> {
    /// Warns of settings of learners with which little or nothing is learned.
    pub fn settings_of_learners(&mut self, items: impl Iterator<Item = &'a Item>) {
        for item in items {
            if let ItemKind::Learn(learn) = &item.kind {
                self.dwells_too_long(learn);
                self.sums_without_end(learn);
                self.learns_nothing(learn);
                self.tries_nothing(learn);
                self.hardly_learns(learn);
                self.tries_more_and_more(learn);
                self.looks_no_further(learn);
                self.looks_next_to_nowhere(learn);
            }
        }
    }

    fn learner(&self, learn: &ast::Learn) -> Option<&Learner> {
        let name = Name::word(crate::check::learned_name(learn));
        let id = self.program.learners.named(&name)?;
        Some(&self.program.learners[id])
    }

    /// A discount of 1 where nothing ends an episode but its limit: the learner does not know the limit.
    fn sums_without_end(&mut self, learn: &'a ast::Learn) {
        let Some(learner) = self.learner(learn) else {
            return;
        };
        let factor = match learner.objective {
            Objective::Discounted(Discount::PerDecision(factor) | Discount::PerTime(factor, _)) => {
                factor
            }
            Objective::Average(_) => return,
        };
        let ends = !self.program.tasks[learner.task].end_on.is_empty();
        if let Some(setting) = setting(learn, "discount").filter(|_| factor >= 1.0 && !ends) {
            self.warning(Code::W0516, setting.value.span, "what is learned is a sum without an end")
                .label("nothing counts less for being late")
                .note("no event ends an episode, and the learner does not know of the limit of its ticks")
                .help("let it be less than 1, such as `0.95 per decision`, or say `objective = average per 1 s` with `method = model`");
        }
    }

    /// A rate of 0: no update changes anything.
    fn learns_nothing(&mut self, learn: &'a ast::Learn) {
        let rate = self.learner(learn).map(|learner| learner.rate);
        let rate = rate.and_then(|rate| self.program.pool.constant(rate));
        if let Some(setting) = setting(learn, "rate").filter(|_| rate == Some(0.0)) {
            self.warning(
                Code::W0517,
                setting.value.span,
                "at this rate nothing is learned",
            )
            .label("no update changes what was known before")
            .help("write a rate above 0, such as `0.1` or `visits^-0.7`");
        }
    }

    /// A share of 0 for what is tried: whatever looks best first is done ever after. Where all looks better than it is at
    /// first, as `initial` may have it, everything is tried all the same.
    fn tries_nothing(&mut self, learn: &'a ast::Learn) {
        let explore = self.learner(learn).map(|learner| learner.explore);
        let explore = explore.map(|explore| range(View::from(&self.program), explore));
        let hopes = setting(learn, "initial").is_some();
        let setting = setting(learn, "explore");
        if let Some(setting) = setting.filter(|_| explore == Some(Interval::just(0.0)) && !hopes) {
            self.warning(Code::W0517, setting.value.span, "nothing is tried")
                .label("in each episode the robot does what looks best so far")
                .help("write a share above 0, such as `35% -> 5%`");
        }
    }

    /// Few episodes, short ones, or a small share for what is tried: most of a policy is chance then.
    fn hardly_learns(&mut self, learn: &'a ast::Learn) {
        let Some(learner) = self.learner(learn) else {
            return;
        };
        let (episodes, ticks) = (learner.episodes, learner.episode_ticks);
        let task = &self.program.tasks[learner.task];
        let (name, whole) = (task.name.clone(), task.end_after);
        let (low, high) = range(View::from(&self.program), learner.explore).ends();
        let (hopes, changes) = (setting(learn, "initial").is_some(), low != high);
        if let Some(setting) = setting(learn, "episodes") {
            if episodes < FEW && !self.told().overlap(setting.value.span) {
                let message = match episodes {
                    1 => "in 1 episode hardly anything is learned".to_owned(),
                    _ => format!("in {episodes} episodes hardly anything is learned"),
                };
                self.warning(Code::W0528, setting.value.span, message)
                    .label("what the policy does is mostly chance")
                    .help("most tasks take some thousands");
            }
            if let Some((_, time)) = setting.tail.as_ref()
                && ticks * PART <= whole
            {
                let message = "what comes later in an episode is never learned";
                let part = whole / ticks;
                self.warning(Code::W0528, time.span, message)
                    .label(format!("the episodes of `{name}` are {part} times as long"));
            }
        }
        if let Some(setting) = setting(learn, "explore")
            && high > 0.0
            && high < SELDOM
            && !hopes
        {
            let at = match &setting.tail {
                Some((_, last)) if changes => setting.value.span.to(last.span),
                _ => setting.value.span,
            };
            self.warning(Code::W0528, at, "hardly anything is tried")
                .label(format!("one decision in {} at most", (1.0 / high).round()))
                .help("most learners begin with more: `35% -> 5%`");
        }
    }

    /// A discount of 0: what a decision leads to counts for nothing.
    fn looks_no_further(&mut self, learn: &'a ast::Learn) {
        let objective = self.learner(learn).map(|learner| learner.objective);
        let factor = match objective {
            Some(Objective::Discounted(
                Discount::PerDecision(factor) | Discount::PerTime(factor, _),
            )) => factor,
            _ => return,
        };
        if let Some(setting) = setting(learn, "discount").filter(|_| factor == 0.0) {
            self.warning(
                Code::W0517,
                setting.value.span,
                "nothing counts but the reward of the decision itself",
            )
            .label("what it leads to is not looked at")
            .help("write a discount above 0, such as `0.95 per decision`");
        }
    }

    /// A discount after which next to nothing is left of what comes soon.
    fn looks_next_to_nowhere(&mut self, learn: &'a ast::Learn) {
        let Some(learner) = self.learner(learn) else {
            return;
        };
        let (factor, after) = match learner.objective {
            Objective::Discounted(Discount::PerDecision(factor)) => (factor, None),
            Objective::Discounted(Discount::PerTime(factor, seconds)) => (factor, Some(seconds)),
            Objective::Average(_) => return,
        };
        let Some(setting) = setting(learn, "discount") else {
            return;
        };
        let tick = self.tick.unwrap_or(1.0);
        let episode = learner.episode_ticks as f64 * tick;
        if factor <= 0.0 || factor >= 1.0 {
            return;
        }
        let ahead = after.map(|after| -after / math::ln(factor));
        let is_short = ahead.is_none_or(|ahead| ahead < episode / SHORT);
        if factor > SMALL {
            let soon = |ahead: &f64| *ahead < SOON.min(AHEAD * tick);
            if let Some(ahead) = ahead.filter(|ahead| is_short && soon(ahead)) {
                let ahead = (ahead * 1e2).round() / 1e2;
                let message = "next to nothing counts but what comes at once";
                self.warning(Code::W0524, setting.value.span, message)
                    .label(format!("what comes {ahead} s later counts for a third"))
                    .help("a discount is mostly for longer: `0.95 per 1 s`, or `per decision`");
            }
            return;
        }
        if !is_short {
            return;
        }
        let per = match &setting.tail {
            Some((_, tail)) => print::expr(tail),
            None => "decision".to_owned(),
        };
        let percent = (factor * 1e3).round() / 10.0;
        let kept = ((1.0 - factor) * 1e9).round() / 1e9;
        let when = match after {
            None => "one decision later".to_owned(),
            Some(_) => format!("{per} later"),
        };
        self.warning(
            Code::W0524,
            setting.value.span,
            "next to nothing counts but what comes at once",
        )
        .label(format!("what comes {when} counts for {percent}%"))
        .help(format!(
            "a discount is what is left, not what is lost: `{kept} per {per}`"
        ));
    }

    fn dwells_too_long(&mut self, learn: &'a ast::Learn) {
        let learner = self.learner(learn);
        let Some((dwell, episode)) = learner.map(|learner| (learner.dwell, learner.episode_ticks))
        else {
            return;
        };
        if let Some(setting) = setting(learn, "dwell").filter(|_| dwell >= episode) {
            self.warning(Code::W0512, setting.value.span, "no episode lasts so long")
                .label("so there is one decision in each episode")
                .note(format!("an episode of learning ends after {episode} ticks"));
        }
    }

    /// A share for what is tried that grows: the more is known, the less it is made use of.
    fn tries_more_and_more(&mut self, learn: &'a ast::Learn) {
        let Some(setting) = setting(learn, "explore") else {
            return;
        };
        let explore = self.learner(learn).map(|learner| learner.explore);
        let grows = explore.is_some_and(|explore| {
            let at = |progress| schedule::value(&self.program.pool, explore, [1.0, progress]);
            at(0.0) < at(1.0)
        });
        let Some((_, last)) = setting.tail.as_ref().filter(|_| grows) else {
            return;
        };
        let [from, to] = [&setting.value, last].map(print::expr);
        let right = format!("{to} -> {from}");
        let at = setting.value.span.to(last.span);
        self.warning(Code::W0525, at, "exploration grows with the episodes")
            .label("the more is known, the less is made of it")
            .fix(format!("write `{right}`"), at, right, Applicability::Unsafe);
    }
}

/// The setting of that name.
fn setting<'a>(learn: &'a ast::Learn, name: &str) -> Option<&'a ast::Setting> {
    learn.entries.iter().find_map(|entry| match entry {
        LearnEntry::Setting(setting) if setting.name.name == name => Some(setting),
        _ => None,
    })
}
