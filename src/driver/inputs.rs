//! A table of numbers and words on its way to a tree: its comparisons, the program that declares them, and the proof that what
//! is printed asks what was meant.

use super::load::{Reader, load};
use super::refused::Refused;
use super::table::refused;
use super::text::Text;
use crate::diagnostic::Code;
use crate::emit::bt::{self, Definition};
use crate::ir::expr::{Binary, Expr, ExprId, Pool};
use crate::ir::input::{self, Input, InputKind};
use crate::ir::program::Predicate;
use crate::ir::tree::{Atom, Tree};
use crate::ir::{Id, Name, Program};
use crate::policy::table::{AtomName, Table};
use crate::policy::valued::{Asks, Column, Columns, Comparison, Holds, Kind, Test, Valued};
use crate::report::decanonicalised::Values;
use crate::tree::atoms::atoms;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A table of values with the comparisons that tell its rows apart.
#[derive(Clone, Debug)]
pub struct Inputs {
    values: Valued,
    /// By the names of their predicates.
    comparisons: BTreeMap<String, Comparison>,
}

impl Inputs {
    /// Chooses the comparisons; with the rows over them.
    ///
    /// # Errors
    /// Rows that contradict each other, or names that do not go together.
    pub fn of(values: Valued, text: Text, tree: &str) -> Result<(Self, Table), Refused> {
        let (chosen, narrowed) = values.compared();
        let names = values.names(&chosen, tree);
        let tests = tests(&values, &chosen, &names);
        let table = narrowed.table(&tests);
        drop(narrowed);
        let table = table.map_err(|errors| refused(text, &errors))?;
        let comparisons = names.into_iter().zip(chosen).collect();
        Ok((
            Self {
                values,
                comparisons,
            },
            table,
        ))
    }

    /// Whether an input is called so.
    pub fn has(&self, name: &str) -> bool {
        self.values.inputs().any(|(_, column)| column.name == name)
    }

    /// How many rows allow several behaviours.
    pub fn several(&self) -> usize {
        let rows = 0..self.values.len();
        rows.filter(|row| self.values.allowed(*row).len() > 1)
            .count()
    }

    /// What a report says of the table.
    pub fn figures(&self) -> Values {
        Values {
            rows: self.values.len(),
            inputs: self.values.inputs().count(),
        }
    }

    /// Declares the inputs in a program, and gives the predicates of the comparisons their meaning.
    pub fn declare(&self, program: &mut Program) {
        let mut ids: BTreeMap<usize, Id<Input>> = BTreeMap::new();
        for (at, column) in self.values.inputs() {
            let kind = match &column.kind {
                Kind::Number(measure, _) => measure.kind(),
                Kind::Category(values) => {
                    InputKind::Category(values.iter().map(Name::word).collect())
                }
                Kind::Truth(_) => continue,
            };
            let name = Name::word(&column.name);
            ids.insert(at, program.inputs.push(Input { name, kind }));
        }
        for id in program.predicates.ids().collect::<Vec<_>>() {
            let name = program.predicates[id].name.bare();
            let Some(comparison) = self.comparisons.get(&name) else {
                continue;
            };
            let Some(input) = ids.get(&comparison.column) else {
                continue;
            };
            let pool = &mut program.pool;
            let input = pool.leaf(Expr::Input(*input));
            let when = match comparison.asks {
                Asks::AtMost(last) => {
                    let cut = pool.num(self.cut(comparison.column, last));
                    pool.binary(Binary::Le, input, cut)
                }
                Asks::Is(value) => {
                    let value = pool.num(f64::from(value));
                    pool.binary(Binary::Eq, input, value)
                }
            };
            let predicate = Predicate {
                name: program.predicates[id].name.clone(),
                when: Some(when),
            };
            program.predicates[id] = predicate;
        }
    }

    /// The number of a cut in SI base units.
    fn cut(&self, column: usize, last: u32) -> f64 {
        let cut = self.values.cut(column, last);
        match (
            cut,
            self.values.columns.get(column).map(|column| &column.kind),
        ) {
            (Some(cut), Some(Kind::Number(measure, _))) => measure.unit.si(cut.value()),
            _ => f64::NAN,
        }
    }

    /// The program as a file: its inputs, its predicates as far as the tree asks them or the table has them, and the tree.
    pub fn written(&self, program: &Program, tree: &Tree, docs: &[String]) -> String {
        let asked = atoms(&tree.root);
        bt::defined(program, |id| self.defined(program, &asked, id), docs)
    }

    /// What each comparison that a tree asks is called there, a line each: who runs the tree elsewhere has to know.
    pub fn legend(&self, program: &Program, tree: &Tree) -> Vec<String> {
        let asked = atoms(&tree.root);
        let predicates = program.predicates.iter();
        let lines = predicates.filter_map(|(id, predicate)| {
            let asks = bt::meaning(&self.defined(program, &asked, id))?;
            Some(format!("`{}` is `{asks}`.", predicate.name.bare()))
        });
        lines.collect()
    }

    /// How a predicate is defined in the file of a tree that asks these atoms.
    fn defined(&self, program: &Program, asked: &BTreeSet<Atom>, id: Id<Predicate>) -> Definition {
        let name = program.predicates[id].name.bare();
        let Some(comparison) = self.comparisons.get(&name) else {
            return Definition::None;
        };
        if !asked.contains(&Atom::Predicate(id)) {
            return Definition::Unused;
        }
        match self.values.columns.get(comparison.column) {
            Some(column) => self.definition(column, *comparison),
            None => Definition::Unused,
        }
    }

    fn definition(&self, column: &Column, comparison: Comparison) -> Definition {
        let name = column.name.clone();
        match (comparison.asks, &column.kind) {
            (Asks::AtMost(last), Kind::Number(measure, _)) => Definition::AtMost {
                name,
                number: self
                    .values
                    .cut(comparison.column, last)
                    .map(|cut| cut.to_string())
                    .unwrap_or_default(),
                unit: measure.unit.text.clone(),
            },
            (Asks::Is(code), Kind::Category(values)) => Definition::Is {
                name,
                value: values.get(code as usize).cloned().unwrap_or_default(),
            },
            _ => Definition::Unused,
        }
    }

    /// Reads what is printed again: the tree has to be the one that was found, and every predicate that it asks has to hold in
    /// the very rows in which the comparison does that the tree was found with.
    ///
    /// # Errors
    /// What is different.
    pub fn prove(&self, program: &Program, tree: &Tree, text: &str) -> Result<(), String> {
        let loaded = load("a tree", text.into(), &mut Alone);
        let mistake = loaded.diagnostics.iter().find(|found| found.is_error());
        let read = match mistake {
            None => &loaded.program,
            // A program of this size is not read again.
            Some(mistake) if mistake.code == Code::E0132 => program,
            Some(mistake) => {
                let why = &mistake.message;
                return Err(format!("what is printed has a mistake: {why}"));
            }
        };
        let again = read.trees.values().find(|again| again.name == tree.name);
        let same = again.map(|again| bt::tree(read, again)) == Some(bt::tree(program, tree));
        if !same {
            return Err("what is printed is another tree".to_owned());
        }
        for atom in atoms(&tree.root) {
            let Atom::Predicate(id) = atom else { continue };
            let name = &program.predicates[id].name;
            let Some(comparison) = self.comparisons.get(&name.bare()) else {
                continue;
            };
            let asked = read.predicates.named(name);
            let when = asked.and_then(|asked| read.predicates[asked].when);
            let column = self.values.columns.get(comparison.column);
            let (Some(when), Some(column)) = (when, column) else {
                return Err(format!("`{name}` is not defined"));
            };
            for code in telling(&read.pool, when, *comparison, column) {
                let value = match &column.kind {
                    Kind::Number(_, values) => values.get(code).map_or(f64::NAN, |(_, si)| *si),
                    _ => code as f64,
                };
                let of = |input: Id<Input>| match read.inputs[input].name.is(&column.name) {
                    true => value,
                    false => f64::NAN,
                };
                let holds = input::value(&read.pool, when, &of);
                if holds != Some(f64::from(comparison.asks.holds(code as u32))) {
                    return Err(format!("`{name}` does not say what was compared"));
                }
            }
        }
        Ok(())
    }
}

/// The codes of a column whose values tell whether a predicate asks this. A number that is compared with one other is so on one side
/// of a place among the ascending values, which the values beside the place tell; else every value has to.
fn telling(pool: &Pool, when: ExprId, comparison: Comparison, column: &Column) -> Range<usize> {
    let all = 0..column.kind.values();
    let Expr::Binary(Binary::Le, input, cut) = pool.get(when) else {
        return all;
    };
    match (pool.get(input), pool.get(cut), comparison.asks) {
        (Expr::Input(_), Expr::Num(_), Asks::AtMost(last)) => {
            let last = last as usize;
            last.min(all.end)..(last + 2).min(all.end)
        }
        _ => all,
    }
}

/// A test for each atom of a table: for the truth values that it has, and for each comparison.
pub(super) fn tests(values: &Valued, comparisons: &[Comparison], names: &[String]) -> Vec<Test> {
    let compared = comparisons
        .iter()
        .zip(names)
        .filter_map(|(compared, name)| {
            let column = values.columns.get(compared.column)?;
            Some(Test {
                name: AtomName::Predicate(name.clone()),
                place: column.place.clone(),
                of: Columns::One(compared.column, Holds::Asked(compared.asks)),
            })
        });
    let mut tests: Vec<Test> = values.truths().chain(compared).collect();
    tests.sort_by_key(|test| match test.of {
        Columns::One(column, _) => column,
        Columns::Several(..) => usize::MAX,
    });
    tests
}

/// A program that uses no files.
struct Alone;

impl Reader for Alone {
    fn read(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Err("it uses no file".to_owned())
    }
}
