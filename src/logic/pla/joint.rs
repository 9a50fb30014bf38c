//! Products that several outputs share.
//!
//! All outputs together are one function of the inputs and of an atom for each output (the output part as a variable of
//! several values: Brayton, Hachtel, McMullen and Sangiovanni-Vincentelli 1984, chapter 2). A row that says something of an
//! output has its atom at 1 and those of the other outputs at 0. A product for some outputs is then a cube that has the atoms
//! of all other outputs at 0, and what meets no OFF row is what is 0 nowhere in any of its outputs.

use super::rest::is_left;
use super::{Cost, Function, Line};
use crate::logic::bits::Bits;
use crate::logic::packed::Packed;
use crate::logic::{Account, Columns, Cover, Cube, Effort, Literal, minimise_within};

/// The most bits of the table of all outputs.
const BITS: usize = 1 << 28;
/// The work for it.
const WORK: u64 = 1 << 28;
/// A first cover may have so many parts more of the products that are wanted.
const HOPE: usize = 8;
/// The work for seeing that products cover a row together.
const CHECK: u64 = 1 << 20;

/// Products for all outputs, or `None` if none are found within the work that is allowed, or likely no fewer than `most`.
pub(super) fn joint(inputs: usize, functions: &[Function], most: usize) -> Option<Vec<Line>> {
    let problem = problem(inputs, functions)?;
    let (columns, on, off) = &problem;
    let account = Account::new(WORK);
    let effort = Effort::default();
    // Where the outputs have little in common, a first cover of all is much larger than the covers of each.
    let first = minimise_within(columns, on, off, &effort.quick(), &account)?;
    if first.cover.cubes().len() > most + most / HOPE {
        return None;
    }
    let solution = minimise_within(columns, on, off, &effort, &account)?;
    let cubes = solution.cover.cubes().iter();
    let lines = cubes.map(|cube| line(inputs, functions.len(), cube));
    Some(lines.collect())
}

/// The products without outputs and literals that they do not need, checked on every row; `None` if they are not right.
pub(super) fn finished(
    inputs: usize,
    functions: &[Function],
    mut lines: Vec<Line>,
) -> Option<Vec<Line>> {
    lines.sort_by_key(|line| std::cmp::Reverse(line.cube.literals().len()));
    for (output, function) in functions.iter().enumerate() {
        drop_output(&mut lines, output, function);
    }
    lines.retain(|line| !line.outputs.is_empty());
    lines
        .iter_mut()
        .for_each(|line| drop_literals(line, functions));
    lines.sort_by_cached_key(|line| (line.outputs.clone(), line.cube.clone()));
    let mut outputs = functions.iter().enumerate();
    outputs
        .all(|(output, function)| is_covered(inputs, &lines, output, function))
        .then_some(lines)
}

/// Whether these products cost less than others: fewer of them, or as many with fewer literals and outputs.
pub(super) fn is_cheaper(lines: &[Line], others: &[Line]) -> bool {
    let cost = |lines| {
        let cost = Cost::of_lines(lines);
        (cost.cubes, cost.inputs + cost.outputs)
    };
    cost(lines) < cost(others)
}

/// The table of all outputs, its ON rows and its OFF rows; `None` where it would be too large.
fn problem(inputs: usize, functions: &[Function]) -> Option<(Columns, Bits, Bits)> {
    let atoms = inputs + functions.len();
    let rows = |part: fn(&Function) -> usize| functions.iter().map(part).sum::<usize>();
    let (ones, zeros) = (rows(|f| f.on.count()), rows(|f| f.off.count()));
    let bits = (ones + zeros).checked_mul(atoms)?;
    if bits > BITS {
        return None;
    }
    let of = |output: usize, columns: &Columns, row: usize| {
        let mut cube = columns.packed(row, atoms);
        for other in 0..functions.len() {
            cube.set(inputs + other, Some(other == output));
        }
        cube
    };
    let all = |part: fn(&Function) -> Bits| {
        let outputs = functions.iter().enumerate();
        outputs.flat_map(move |(output, function)| {
            let rows: Vec<usize> = part(function).iter().collect();
            rows.into_iter()
                .map(move |row| of(output, &function.columns, row))
        })
    };
    let cubes: Vec<Packed> = all(|f| f.on.clone())
        .chain(all(|f| f.off.clone()))
        .collect();
    Some((
        Columns::of(atoms, &cubes),
        Bits::collect(cubes.len(), 0..ones),
        Bits::collect(cubes.len(), ones..cubes.len()),
    ))
}

/// A cube over inputs and outputs as a product.
fn line(inputs: usize, outputs: usize, cube: &Cube) -> Line {
    let literals = cube.literals().iter().copied();
    let (own, of_outputs): (Vec<Literal>, Vec<Literal>) = literals.partition(|l| l.atom < inputs);
    let only = of_outputs.iter().find(|literal| literal.positive);
    let excludes = |output: &usize| of_outputs.iter().any(|l| l.atom == inputs + output);
    Line {
        cube: Cube::new(own),
        outputs: match only {
            Some(literal) => vec![literal.atom - inputs],
            None => (0..outputs).filter(|output| !excludes(output)).collect(),
        },
    }
}

/// Takes an output out of the products that it does not need.
fn drop_output(lines: &mut [Line], output: usize, function: &Function) {
    let within = |line: &Line| function.columns.cube_rows(&line.cube, &function.on);
    let covers: Vec<Option<Bits>> = lines
        .iter()
        .map(|line| line.outputs.contains(&output).then(|| within(line)))
        .collect();
    let mut times = vec![0_usize; function.columns.rows()];
    for row in covers.iter().flatten().flat_map(Bits::iter) {
        if let Some(times) = times.get_mut(row) {
            *times += 1;
        }
    }
    for (line, covers) in lines.iter_mut().zip(covers) {
        let Some(covers) = covers else { continue };
        // A row that lies in this product only in part may need it, too.
        let meets = function.columns.cube_meets(&line.cube, &function.on);
        let by_others =
            |row| times.get(row).copied().unwrap_or(0) > usize::from(covers.contains(row));
        if meets.iter().all(by_others) {
            line.outputs.retain(|other| *other != output);
            for row in covers.iter() {
                if let Some(times) = times.get_mut(row) {
                    *times -= 1;
                }
            }
        }
    }
}

/// Takes the literals out of a product that its outputs do not need.
fn drop_literals(line: &mut Line, functions: &[Function]) {
    let is_off = |cube: &Cube| {
        let mut functions = line
            .outputs
            .iter()
            .filter_map(|output| functions.get(*output));
        functions.any(|function| !function.columns.cube_meets(cube, &function.off).is_empty())
    };
    let mut cube = line.cube.clone();
    for literal in line.cube.literals() {
        let shorter = cube.without(*literal);
        if !is_off(&shorter) {
            cube = shorter;
        }
    }
    line.cube = cube;
}

/// Whether the products of an output are 1 on its ON rows, and on none of its OFF rows.
fn is_covered(inputs: usize, lines: &[Line], output: usize, function: &Function) -> bool {
    let own = lines.iter().filter(|line| line.outputs.contains(&output));
    let cover = Cover::new(own.map(|line| line.cube.clone()));
    let columns = &function.columns;
    if !columns.cover_meets(&cover, &function.off).is_empty() {
        return false;
    }
    let packed: Vec<Packed> = cover
        .cubes()
        .iter()
        .map(|cube| Packed::of(inputs, cube))
        .collect();
    let open = function.on.minus(&columns.cover_rows(&cover, &function.on));
    let packed: Vec<&Packed> = packed.iter().collect();
    open.iter().all(|row| {
        let row = columns.packed(row, inputs);
        !is_left(&row, &[&row], &packed, &mut { CHECK })
    })
}
