//! What decisions led to, counted: a model of the process as the trees that grow meet it.

pub use super::cell::{Cell, KNOWN, Sight};
use super::cell::{Hazard, MOST};
use super::gathered::{Excursion, Gathered};
use super::ground::Ground;
use crate::learn::discount::Discounting;
use crate::learn::episode::Controller;
use crate::learn::process::{End, Key, World};
use crate::learn::solve::{Problem, Solution};
use crate::trial::decisions::Taken;
use crate::world::Start;
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

/// The decisions by which counts are doubted, see [`Evidence::doubted`].
const DOUBT: f64 = 15.0;

/// How often caution is taken anew with the values that it led to.
const CAUTIONS: usize = 2;

/// The part of an episode over which rewards count in the far sight.
pub(super) const FAR: f64 = 0.3;

/// Counted decisions.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Evidence {
    choices: usize,
    discounts: [Discounting; 2],
    keys: Vec<Key>,
    rows: FxHashMap<Key, usize>,
    cells: Vec<Cell>,
    /// The reward of failing at once: its sum, and how often it was met.
    refused: (f64, f64),
    /// What a harm costs, besides what it loses.
    harm: f64,
    /// The most that a cell counts.
    most: f64,
    /// The minterms in which episodes began, with how often.
    starts: FxHashMap<Key, f64>,
}

/// How often a tree was in each minterm in an episode, on average, by key.
pub type Visits = FxHashMap<Key, f64>;

impl Evidence {
    /// None.
    pub fn new<W>(ground: &Ground<W>) -> Self {
        let far = Discounting {
            discount: crate::ir::task::Discount::PerTime(
                crate::math::exp(-1.0),
                FAR * ground.start.limit as f64,
            ),
            tick: 1.0,
        };
        Self {
            choices: ground.choices.len(),
            discounts: [ground.discounting, far],
            keys: Vec::new(),
            rows: FxHashMap::default(),
            cells: Vec::new(),
            refused: (0.0, 0.0),
            harm: 0.0,
            most: MOST,
            starts: FxHashMap::default(),
        }
    }

    /// None, of a process that does not change: nothing makes room.
    pub(super) fn whole<W>(ground: &Ground<W>) -> Self {
        Self {
            most: f64::INFINITY,
            ..Self::new(ground)
        }
    }

    /// Charges so much for a harm from now on.
    pub fn charge(&mut self, harm: f64) {
        self.harm = harm;
    }

    /// The minterms that were met, by row.
    pub fn keys(&self) -> &[Key] {
        &self.keys
    }

    /// The row of a minterm.
    pub fn row(&self, key: Key) -> Option<usize> {
        self.rows.get(&key).copied()
    }

    /// What is known of the choices in a row.
    pub fn cells(&self, row: usize) -> &[Cell] {
        let from = row * self.choices;
        self.cells.get(from..from + self.choices).unwrap_or(&[])
    }

    /// Which choices fail at once, in each row.
    pub fn refusing(&self) -> Vec<Vec<bool>> {
        let rows = self.cells.chunks(self.choices.max(1));
        rows.map(|cells| cells.iter().map(Cell::refuses).collect())
            .collect()
    }

    /// How many episodes from the task's own starts began in a minterm.
    pub fn begun(&self, key: Key) -> f64 {
        self.starts.get(&key).copied().unwrap_or_default()
    }

    /// The mean reward of failing at once.
    pub fn refusal(&self) -> f64 {
        self.refused.0 / self.refused.1.max(1.0)
    }

    fn find(&mut self, key: Key) -> usize {
        let next = self.keys.len();
        let row = *self.rows.entry(key).or_insert(next);
        if row == next {
            self.keys.push(key);
            self.cells
                .resize((next + 1) * self.choices, Cell::default());
        }
        row
    }

    /// Plays about `ticks` ticks under a tree or a policy, counts what its decisions lead to, and gives the visits with the
    /// ticks that were played. Of the decisions, a part `explore` is random.
    pub fn collect<W: World>(
        &mut self,
        ground: &Ground<W>,
        controller: &(impl Controller + Clone + Sync),
        (explore, start): (f64, Start),
        ticks: u64,
    ) -> (Visits, u64) {
        let mut visits = Visits::default();
        let (mut used, mut episodes) = (0, 0);
        let excursions = Excursion::all(ground, self);
        while used < ticks {
            let gathered = Gathered::batch(
                ground,
                controller,
                (explore, &excursions),
                (start, episodes),
                (ticks, used),
            );
            episodes += gathered.len() as u64;
            for gathered in gathered {
                used += gathered.ticks;
                self.count_all(&gathered.taken);
                if let (Some(first), true) =
                    (gathered.visits.first(), start.lines == ground.start.lines)
                {
                    *self.starts.entry(*first).or_default() += 1.0;
                }
                for key in gathered.visits {
                    *visits.entry(key).or_default() += 1.0;
                }
            }
        }
        for count in visits.values_mut() {
            *count /= episodes as f64;
        }
        (visits, used)
    }

    /// Counts the decisions of an episode.
    pub fn count_all(&mut self, taken: &[Taken]) {
        taken.iter().for_each(|taken| self.count(taken));
    }

    /// Counts a decision.
    pub(super) fn count(&mut self, taken: &Taken) {
        // What the limit cut has no outcome.
        if taken.end == End::Cut {
            return;
        }
        let row = self.find(taken.from);
        let next = (!matches!(taken.end, End::Terminal(_))).then(|| self.find(taken.to));
        let factors = self.discounts.map(|discount| discount.factor(taken.ticks));
        if taken.is_refused() {
            self.refused.0 += taken.reward;
            self.refused.1 += 1.0;
        }
        let most = self.most;
        if let Some(cell) = self.cells.get_mut(row * self.choices + taken.choice) {
            cell.fade(most);
            cell.add(taken, next.map(|next| (next, factors)));
        }
    }

    /// The decision problem of the counts.
    pub fn problem(&self, sight: Sight) -> Problem {
        self.doubted(sight, DOUBT)
    }

    /// The decision problem of the counts, and of so many decisions more in each cell that go as badly as any in the
    /// minterm: what is rare and dear is not met in a few decisions.
    pub fn doubted(&self, sight: Sight, doubt: f64) -> Problem {
        let anywhere = Hazard::of(&self.cells, self.harm);
        let known = |row: &[Cell]| {
            let here = Hazard::of(row, self.harm).with(&anywhere);
            let known = |cell: &Cell| cell.count >= KNOWN;
            // A choice that fails at once is no way to wait: a tree goes on to the next.
            let acts = |cell: &Cell| known(cell) && !cell.refuses();
            let waits = row.iter().any(acts);
            let choices = row.iter().enumerate();
            let kept = choices.filter(|(_, cell)| if waits { acts(cell) } else { known(cell) });
            kept.map(|(choice, cell)| (choice, cell.outlook(sight, doubt, &here)))
                .collect()
        };
        Problem {
            states: self.cells.chunks(self.choices.max(1)).map(known).collect(),
            unknown: 0.0,
        }
    }

    /// A problem of these counts with each reward less by so many standard errors of what the choice is worth, and its solution.
    pub fn cautious(&self, problem: &Problem, care: f64, sight: Sight) -> (Problem, Solution) {
        let mut cautious = problem.clone();
        let mut solution = cautious.estimate_from(cautious.unsolved());
        for _ in 0..CAUTIONS {
            let values = &solution.values;
            cautious.unknown = problem.low(values);
            let worth = |row: usize| match problem.states.get(row) {
                Some(state) if !state.is_empty() => values.get(row).copied(),
                _ => None,
            };
            let unknown = cautious.unknown;
            let value = |row: usize| worth(row).unwrap_or(unknown);
            for (row, (state, plain)) in cautious.states.iter_mut().zip(&problem.states).enumerate()
            {
                for ((choice, outlook), (_, plain)) in state.iter_mut().zip(plain) {
                    let cell = self.cells(row).get(*choice);
                    let error = cell.map_or(0.0, |cell| {
                        (cell.variance(sight, value) / cell.count).sqrt()
                    });
                    outlook.reward = plain.reward - care * error;
                }
            }
            solution = cautious.estimate_from(solution);
        }
        (cautious, solution)
    }

    /// What each choice is worth under the best policy of the counts, with the variance of one decision, by row and
    /// choice; `None` where it is not known.
    pub fn worths(&self, sight: Sight) -> Vec<Vec<Option<(f64, f64)>>> {
        let problem = self.problem(sight);
        let values = problem.estimate_from(problem.unsolved()).values;
        let value = |row: usize| values.get(row).copied().unwrap_or(problem.unknown);
        let rows = problem.states.iter().enumerate();
        rows.map(|(row, state)| {
            let mut worths = vec![None; self.choices];
            for (choice, outlook) in state {
                let cell = self.cells(row).get(*choice);
                if let (Some(worth), Some(cell)) = (worths.get_mut(*choice), cell) {
                    let mean = problem.worth(outlook, &values);
                    *worth = Some((mean, cell.variance(sight, value)));
                }
            }
            worths
        })
        .collect()
    }
}
