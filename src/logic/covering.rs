//! Set covering: the cheapest choice of columns that covers every row.

use super::bits::Bits;

/// Something that can be chosen.
#[derive(Clone, Debug)]
pub struct Choice {
    /// What it covers.
    pub covers: Bits,
    /// What it costs, after the number of choices.
    pub weight: usize,
}

/// Number of choices, then their weights.
type Cost = (usize, usize);

/// A cover by greedy choice, made irredundant: most rows first, then least weight, then order.
fn greedy(rows: &Bits, choices: &[Choice]) -> Vec<usize> {
    let mut left = rows.clone();
    let mut chosen = Vec::new();
    while !left.is_empty() {
        let best = choices
            .iter()
            .enumerate()
            .map(|(i, choice)| (choice.covers.count_both(&left), i, choice))
            .max_by_key(|(gain, i, choice)| {
                (
                    *gain,
                    std::cmp::Reverse(choice.weight),
                    std::cmp::Reverse(*i),
                )
            });
        match best {
            Some((gain, i, choice)) if gain > 0 => {
                left = left.minus(&choice.covers);
                chosen.push(i);
            }
            _ => break,
        }
    }
    irredundant(rows, choices, chosen)
}

/// Drops choices that the others make superfluous, heavy ones first.
fn irredundant(rows: &Bits, choices: &[Choice], mut chosen: Vec<usize>) -> Vec<usize> {
    let weight = |i: &usize| choices.get(*i).map_or(0, |choice| choice.weight);
    let mut by_weight = chosen.clone();
    by_weight.sort_by_key(|i| std::cmp::Reverse((weight(i), *i)));
    for i in by_weight {
        let covered = chosen
            .iter()
            .filter(|other| **other != i)
            .filter_map(|other| choices.get(*other))
            .fold(Bits::empty(rows.bound()), |covered, choice| {
                covered.or(&choice.covers)
            });
        if rows.is_subset(&covered) {
            chosen.retain(|other| *other != i);
        }
    }
    chosen
}

/// The cheapest cover, found by branch and bound from the greedy one, and whether it is proved to be: the search ended
/// within `budget` steps.
pub fn cheapest(rows: &Bits, choices: &[Choice], budget: usize) -> (Vec<usize>, bool) {
    let best = greedy(rows, choices);
    let useful = undominated(choices);
    let mut through: Vec<(usize, Vec<usize>)> = rows
        .iter()
        .map(|row| {
            let covers = |i: &usize| choices.get(*i).is_some_and(|c| c.covers.contains(row));
            (row, useful.iter().copied().filter(covers).collect())
        })
        .collect();
    through.sort_by_key(|(row, choices)| (choices.len(), *row));
    let mut search = Search {
        choices,
        through,
        cost: cost(choices, &best),
        best,
        budget,
        complete: true,
    };
    search.branch(rows, &mut Vec::new(), (0, 0));
    search.best.sort_unstable();
    (search.best, search.complete)
}

/// The choices that no other makes superfluous by covering as much for as little.
fn undominated(choices: &[Choice]) -> Vec<usize> {
    let mut order: Vec<(usize, &Choice)> = choices.iter().enumerate().collect();
    order.sort_by_key(|(i, choice)| (choice.weight, std::cmp::Reverse(choice.covers.count()), *i));
    let mut kept: Vec<(usize, &Choice)> = Vec::new();
    for (i, choice) in order {
        // What stands earlier is no heavier.
        if !kept
            .iter()
            .any(|(_, earlier)| choice.covers.is_subset(&earlier.covers))
        {
            kept.push((i, choice));
        }
    }
    let mut kept: Vec<usize> = kept.into_iter().map(|(i, _)| i).collect();
    kept.sort_unstable();
    kept
}

fn cost(choices: &[Choice], chosen: &[usize]) -> Cost {
    let weights = chosen.iter().filter_map(|i| choices.get(*i));
    (chosen.len(), weights.map(|choice| choice.weight).sum())
}

struct Search<'a> {
    choices: &'a [Choice],
    /// The choices that cover each row, rows with few of them first.
    through: Vec<(usize, Vec<usize>)>,
    best: Vec<usize>,
    cost: Cost,
    budget: usize,
    complete: bool,
}

impl Search<'_> {
    fn branch(&mut self, left: &Bits, chosen: &mut Vec<usize>, spent: Cost) {
        if left.is_empty() {
            if spent < self.cost {
                self.cost = spent;
                self.best.clone_from(chosen);
            }
            return;
        }
        if self.budget == 0 {
            self.complete = false;
            return;
        }
        self.budget -= 1;
        let bound = self.bound(left);
        if (spent.0 + bound.0, spent.1 + bound.1) >= self.cost {
            return;
        }
        let choices = self.choices;
        let hardest = self.through.iter().find(|(row, _)| left.contains(*row));
        let through = hardest.into_iter().flat_map(|(_, through)| through);
        let mut through: Vec<(usize, usize, &Choice)> = through
            .filter_map(|i| Some((*i, choices.get(*i)?)))
            .map(|(i, choice)| (choice.covers.count_both(left), i, choice))
            .collect();
        through.sort_by_key(|(gain, i, choice)| (std::cmp::Reverse(*gain), choice.weight, *i));
        for (_, i, choice) in through {
            chosen.push(i);
            self.branch(
                &left.minus(&choice.covers),
                chosen,
                (spent.0 + 1, spent.1 + choice.weight),
            );
            chosen.pop();
        }
    }

    /// What is left costs at least this: rows without a choice in common need one each.
    fn bound(&self, left: &Bits) -> Cost {
        let mut open = left.clone();
        let mut bound = (0, 0);
        for (row, through) in &self.through {
            if !open.contains(*row) {
                continue;
            }
            let choices = through.iter().filter_map(|i| self.choices.get(*i));
            let mut lightest = usize::MAX;
            for choice in choices {
                lightest = lightest.min(choice.weight);
                open.subtract(&choice.covers);
            }
            bound = (bound.0 + 1, bound.1 + lightest);
        }
        bound
    }
}
