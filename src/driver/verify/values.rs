//! A tree against a table of numbers and words: row by row, with the values that the predicates of the program compare.

use super::Proved;
use crate::diagnostic::{Code, Diagnostic};
use crate::driver::load::Loaded;
use crate::driver::{Refused, Text, inputs, table};
use crate::ir::expr::{Binary, Expr, ExprId};
use crate::ir::input::{self, Input, InputKind};
use crate::ir::law::Behavior;
use crate::ir::program::Predicate;
use crate::ir::tree::{Atom, Tree};
use crate::ir::{Id, Name, Program};
use crate::policy::table::AtomName;
use crate::policy::valued::{Column, Columns, Holds, Kind, OPEN, Test, Valued};
use crate::report::verdict::Answer;
use crate::report::words::counted;
use crate::source::Span;
use crate::tree::atoms::atoms;
use crate::tree::cube::{Cube, Reader, positions};
use crate::tree::tick::Runner;
use std::collections::BTreeSet;
use std::ops::Range;

/// The most parts of rows that leave inputs open which are looked at.
const PARTS: usize = 1 << 20;

/// The most rows to list that a tree decides otherwise.
const LISTED: usize = 10;

/// Proves that a tree takes a decision that a table allows, in each of its rows.
///
/// # Errors
/// The table contradicts itself, or does not say what the tree asks; the tree has memory.
pub fn table(
    loaded: &Loaded,
    id: Id<Tree>,
    text: Text,
    values: &Valued,
) -> Result<Proved, Refused> {
    let program = &loaded.program;
    let tree = &program.trees[id];
    let sides = Sides {
        program,
        tree,
        text,
        values,
    };
    sides.consistent()?;
    let asked: Vec<Atom> = atoms(&tree.root).into_iter().collect();
    let tests = asked.iter().map(|atom| sides.test(*atom));
    let tests: Vec<Test> = tests.collect::<Result<_, Refused>>()?;
    let runner = Runner::new(&tree.root, &asked);
    let (false, Ok(runner)) = (tree.root.remembers(), runner) else {
        let message = "a table of values is compared with trees without memory";
        return Err(sides.refused(values.header.clone(), Code::E0826, message, ""));
    };
    sides.compared(runner, &asked, &tests)
}

/// A table of values has no transitions.
pub fn no_transitions(text: Text) -> Refused {
    Refused::text(text, |file| {
        let message = "a table of values is compared without transitions";
        vec![Diagnostic::new(Code::E0826, Span::new(file, 0, 0), message)]
    })
}

/// A tree and the table that it is compared with.
struct Sides<'a> {
    program: &'a Program,
    tree: &'a Tree,
    text: Text<'a>,
    values: &'a Valued,
}

impl Sides<'_> {
    fn compared(
        &self,
        mut runner: Runner,
        asked: &[Atom],
        tests: &[Test],
    ) -> Result<Proved, Refused> {
        let values = self.values;
        let names: Vec<&str> = values.behaviors().collect();
        let of = |behavior: Id<Behavior>| self.program.behaviors[behavior].name.bare();
        let mut wrong: Vec<(usize, Option<Id<Behavior>>)> = Vec::new();
        let positions = positions(asked);
        let reader = Reader::new(&self.tree.root);
        let (mut left, mut stopped) = (PARTS, None);
        let each = values.cubes(tests, |row, words, fields| {
            let is_right = |selected: Option<Id<Behavior>>| {
                let allowed = values.allowed(row).iter();
                let mut allowed = allowed.filter_map(|number| names.get(*number as usize));
                selected.is_some_and(|id| allowed.any(|name| *name == of(id)))
            };
            if fields.is_empty() {
                let selected = runner.select(words);
                if !is_right(selected) {
                    wrong.push((row, selected));
                }
                return;
            }
            let reader = match &reader {
                Ok(reader) if stopped.is_none() => reader,
                Ok(_) => return,
                Err(why) => {
                    stopped = stopped.take().or_else(|| Some((row, why.to_string())));
                    return;
                }
            };
            let mut cube = Cube::of_fields(words, &positions, fields);
            let mut say = |_: &Cube, selected: Option<Id<Behavior>>| {
                let right = is_right(selected);
                if !right {
                    wrong.push((row, selected));
                }
                right
            };
            if reader.parts(&mut cube, &mut left, &mut say).is_err() {
                stopped = Some((row, "there are too many cases to tell apart".to_owned()));
            }
        });
        each.map_err(|error| table::refused(self.text, &[error]))?;
        if let (Some((row, why)), true) = (stopped, wrong.is_empty()) {
            let message = "what the tree selects where this row leaves inputs open is not known";
            return Err(self.refused(values.place(row), Code::E0826, message, &why));
        }
        let (tree, table) = (&self.tree.name, self.text.name);
        let rows = counted(values.len(), "row");
        if wrong.is_empty() {
            return Ok(Proved {
                answer: Answer::Holds,
                text: format!("equal: `{tree}` takes the decisions of {table} in {rows}"),
            });
        }
        let mut lines = vec![format!(
            "different: `{tree}` decides {} of {rows} of {table} otherwise",
            wrong.len()
        )];
        let listed = wrong.iter().take(LISTED).map(|(row, selected)| {
            let allowed = values.allowed(*row).iter();
            let allowed = allowed.filter_map(|number| names.get(*number as usize).copied());
            let allowed: Vec<&str> = allowed.collect();
            format!(
                "  {table}:{}: {}: the table says {}, `{tree}` selects {}",
                self.line(*row),
                self.state(*row),
                allowed.join("|"),
                selected.map_or_else(|| "nothing".to_owned(), of),
            )
        });
        lines.extend(listed);
        Ok(Proved {
            answer: Answer::Fails,
            text: lines.join("\n"),
        })
    }

    /// The line of a row.
    fn line(&self, row: usize) -> usize {
        let start = self.values.place(row).start;
        let before = self.text.bytes.get(..start).unwrap_or_default();
        1 + before.iter().filter(|byte| **byte == b'\n').count()
    }

    /// The state of a row in words; what holds not and what is left open is not told.
    fn state(&self, row: usize) -> String {
        let columns = self.values.columns.iter().enumerate();
        let said = columns.filter_map(|(at, column)| {
            let code = self.values.code(at, row);
            match &column.kind {
                _ if code == OPEN => None,
                Kind::Truth(_) => (code == 1).then(|| column.name.clone()),
                Kind::Number(measure, values) => {
                    let (number, _) = values.get(code as usize)?;
                    let unit = &measure.unit.text;
                    let blank = if matches!(unit.as_str(), "" | "%") {
                        ""
                    } else {
                        " "
                    };
                    Some(format!("{} = {number}{blank}{unit}", column.name))
                }
                Kind::Category(values) => {
                    Some(format!("{} = {}", column.name, values.get(code as usize)?))
                }
            }
        });
        let said: Vec<String> = said.collect();
        format!("{{{}}}", said.join(", "))
    }

    /// Refuses a table whose rows contradict each other.
    fn consistent(&self) -> Result<(), Refused> {
        let (comparisons, narrowed) = self.values.compared();
        let names = self.values.names(&comparisons, "");
        let tests = inputs::tests(self.values, &comparisons, &names);
        let table = narrowed.table(&tests);
        table.map_err(|errors| table::refused(self.text, &errors))?;
        Ok(())
    }

    /// How an atom of the tree follows from the columns of the table.
    fn test(&self, atom: Atom) -> Result<Test, Refused> {
        let shown = self.program.atom_name(atom);
        let name = AtomName::read(&match atom {
            Atom::Predicate(id) => self.program.predicates[id].name.bare(),
            Atom::Done(_) | Atom::Failed(_) => shown.to_string(),
        });
        let mut truths = self.values.truths();
        if let Some(test) = truths.find(|test| test.name == name) {
            return Ok(test);
        }
        let reads = |expr: Expr| matches!(expr, Expr::Input(_));
        if let Atom::Predicate(id) = atom
            && let Some(when) = self.program.predicates[id].when
            && self.program.pool.any(when, &mut |expr| reads(expr))
        {
            return self.compares(id, when, name);
        }
        Err({
            let tree = &self.tree.name;
            let message =
                format!("the table does not say whether `{shown}` holds, and `{tree}` asks it");
            self.refused(
                self.values.header.clone(),
                Code::E0610,
                &message,
                "there is no such column",
            )
        })
    }

    /// How a predicate follows that compares inputs.
    fn compares(&self, id: Id<Predicate>, when: ExprId, name: AtomName) -> Result<Test, Refused> {
        let pool = &self.program.pool;
        let mut read: BTreeSet<Id<Input>> = BTreeSet::new();
        pool.any(when, &mut |expr| {
            if let Expr::Input(input) = expr {
                read.insert(input);
            }
            false
        });
        let columns = read.iter().map(|input| self.column(id, *input));
        let columns: Vec<usize> = columns.collect::<Result<_, Refused>>()?;
        let of = |input: Id<Input>, code: u32| {
            let at = read.iter().position(|known| *known == input);
            let column = at.and_then(|at| self.values.columns.get(*columns.get(at)?));
            column.map_or(f64::NAN, |column| self.value(input, column, code))
        };
        let holds = |of: &dyn Fn(Id<Input>) -> f64| {
            let value = input::value(pool, when, &of);
            value.is_some_and(|value| value != 0.0)
        };
        let place = |column: &usize| {
            let column = self.values.columns.get(*column);
            column.map_or(0..0, |column| column.place.clone())
        };
        let place = columns.first().map_or(0..0, place);
        if let ([column], Some(input)) = (columns.as_slice(), read.first()) {
            let kind = self.values.columns.get(*column);
            let codes = kind.map_or(0, |column| column.kind.values());
            let codes = (0..codes).map(|code| holds(&|input| of(input, code as u32)));
            let mut truths: Vec<bool> = codes.collect();
            let open = kind.is_some_and(|column| column.codes.contains(&OPEN));
            if open && let InputKind::Number { .. } = self.program.inputs[*input].kind {
                let more = self.between(id, when, &place)?;
                truths.extend(more.iter().map(|value| holds(&|_| *value)));
            }
            let of = Columns::One(*column, Holds::Listed(truths));
            return Ok(Test { name, place, of });
        }
        let rows = (0..self.values.len()).map(|row| {
            holds(&|input| {
                let at = read.iter().position(|known| *known == input);
                let column = at.and_then(|at| columns.get(at)).copied();
                of(
                    input,
                    column.map_or(OPEN, |column| self.values.code(column, row)),
                )
            })
        });
        let rows = rows.collect();
        let of = Columns::Several(columns.clone(), rows);
        Ok(Test { name, place, of })
    }

    /// The column of an input that a predicate compares.
    fn column(&self, id: Id<Predicate>, input: Id<Input>) -> Result<usize, Refused> {
        let predicate = &self.program.predicates[id].name;
        let Input { name, kind } = &self.program.inputs[input];
        let mut columns = self.values.inputs();
        let Some((at, column)) = columns.find(|(_, column)| name.is(&column.name)) else {
            let message = format!("the table does not say `{name}`, and `{predicate}` asks it");
            let header = self.values.header.clone();
            return Err(self.refused(header, Code::E0610, &message, "there is no such column"));
        };
        let refused = |message: String, label: &str| {
            Err(self.refused(column.place.clone(), Code::E0610, &message, label))
        };
        match (kind, &column.kind) {
            (InputKind::Number { dim, .. }, Kind::Number(measure, _)) if *dim == measure.dim => {
                Ok(at)
            }
            (InputKind::Number { dim, .. }, Kind::Number(measure, _)) => refused(
                format!("`{name}` is {dim} in the program, and {} here", measure.dim),
                "its unit is another",
            ),
            (InputKind::Category(known), Kind::Category(values)) => {
                let known = |value: &&String| known.iter().any(|name| name.is(value));
                match values.iter().find(|value| !known(value)) {
                    None => Ok(at),
                    Some(value) => refused(
                        format!("`{value}` is no value of `{name}` in the program"),
                        "a column with this value",
                    ),
                }
            }
            (InputKind::Number { .. }, _) => {
                refused(format!("`{name}` is a number in the program"), "no numbers")
            }
            (InputKind::Category(_), _) => refused(
                format!("`{name}` has one of some values in the program"),
                "other than here",
            ),
        }
    }

    /// What an input is in the program where a column has this code.
    fn value(&self, input: Id<Input>, column: &Column, code: u32) -> f64 {
        match (&self.program.inputs[input].kind, &column.kind) {
            (InputKind::Number { .. }, Kind::Number(_, values)) => {
                values.get(code as usize).map_or(f64::NAN, |(_, si)| *si)
            }
            (InputKind::Category(known), Kind::Category(values)) => {
                let value = values.get(code as usize);
                let at = value.and_then(|value| known.iter().position(|name| name.is(value)));
                at.map_or(f64::NAN, |at| at as f64)
            }
            _ => f64::NAN,
        }
    }

    /// Numbers that stand for all others, between those that the program compares an input with; refused where a predicate does
    /// more with it.
    fn between(
        &self,
        id: Id<Predicate>,
        when: ExprId,
        place: &Range<usize>,
    ) -> Result<Vec<f64>, Refused> {
        let pool = &self.program.pool;
        let compared = |expr: Expr| match expr {
            Expr::Binary(Binary::Le | Binary::Lt | Binary::Eq | Binary::Ne, a, b) => {
                match (pool.get(a), pool.get(b)) {
                    (Expr::Input(_), Expr::Num(number)) | (Expr::Num(number), Expr::Input(_)) => {
                        Some(number)
                    }
                    _ => None,
                }
            }
            _ => None,
        };
        let does_more = pool.any(when, &mut |expr| {
            let reads = |id: ExprId| matches!(pool.get(id), Expr::Input(_));
            match expr {
                Expr::Unary(_, a) => reads(a),
                Expr::Binary(_, a, b) => (reads(a) || reads(b)) && compared(expr).is_none(),
                Expr::Select(_, a, b) => reads(a) || reads(b),
                _ => false,
            }
        });
        if does_more {
            let name: &Name = &self.program.predicates[id].name;
            let message = format!("`{name}` does more with this column than compare it");
            let label = "rows that leave it open with `-` say too little";
            return Err(self.refused(place.clone(), Code::E0826, &message, label));
        }
        let mut numbers: Vec<f64> = pool.iter().filter_map(|(_, expr)| compared(expr)).collect();
        numbers.sort_by(f64::total_cmp);
        numbers.dedup();
        let ends = [numbers.first(), numbers.last()];
        let [below, above] = ends.map(|end| end.copied().unwrap_or(0.0));
        let middles = numbers.iter().zip(numbers.iter().skip(1));
        let middles: Vec<f64> = middles.map(|(a, b)| a + (b - a) / 2.0).collect();
        let outside = [below - below.abs().max(1.0), above + above.abs().max(1.0)];
        Ok(numbers.into_iter().chain(middles).chain(outside).collect())
    }

    fn refused(&self, place: Range<usize>, code: Code, message: &str, label: &str) -> Refused {
        Refused::text(self.text, |file| {
            let span = Span::new(file, place.start, place.end);
            let found = Diagnostic::new(code, span, message);
            vec![if label.is_empty() {
                found
            } else {
                found.label(label)
            }]
        })
    }
}
