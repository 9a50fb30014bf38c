//! Products for several outputs, made fewer by EXPAND, IRREDUNDANT and REDUCE (Brayton, Hachtel, McMullen and
//! Sangiovanni-Vincentelli 1984).
//!
//! Unlike covers of rows, several products may cover a cube of the file together, and one may serve several outputs. Only
//! what the file says of an output counts: a product is needed where it is 1, and may not meet where it is 0.

use super::rest::{is_left, rest};
use super::{Function, Line};
use crate::logic::packed::Packed;
use crate::logic::{Cube, Literal};
use std::cmp::Reverse;

/// Products that are looked at as what a product is expanded to, those at the least distance first.
const NEAR: usize = 24;
/// Times that the three steps are done without success.
const VAIN: usize = 2;
/// The work for dropping at last what is superfluous.
const TIDY: u64 = 1 << 22;

/// A cube with the outputs that are 1 on it.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Product {
    cube: Packed,
    outputs: Vec<bool>,
}

impl Product {
    fn serves(&self, output: usize) -> bool {
        self.outputs.get(output).copied().unwrap_or(false)
    }

    fn contains(&self, other: &Self) -> bool {
        let mut outputs = self.outputs.iter().zip(&other.outputs);
        outputs.all(|(own, other)| *own || !other) && self.cube.contains(&other.cube)
    }

    /// The smallest product that contains both.
    fn supercube(&self, other: &Self) -> Self {
        let outputs = self.outputs.iter().zip(&other.outputs);
        Self {
            cube: self.cube.supercube(&other.cube),
            outputs: outputs.map(|(own, other)| own | other).collect(),
        }
    }

    fn size(&self) -> usize {
        self.cube.literals() + self.outputs.iter().filter(|serves| **serves).count()
    }
}

/// The outputs of a PLA, and what work is left for them.
pub(super) struct Problem<'a> {
    inputs: usize,
    functions: &'a [Function<'a>],
    /// The ON cubes of each output.
    on: Vec<Vec<Packed>>,
    work: u64,
}

impl<'a> Problem<'a> {
    /// The problem of these outputs, with work for it, in cubes and words that are read.
    pub(super) fn new(inputs: usize, functions: &'a [Function<'a>], work: u64) -> Self {
        let on = |function: &Function| {
            let rows = function.on.iter();
            rows.map(|row| function.columns.packed(row, inputs))
                .collect()
        };
        Self {
            inputs,
            functions,
            on: functions.iter().map(on).collect(),
            work,
        }
    }

    /// What the file itself says: its ON cubes, those of several outputs once.
    pub(super) fn given(&self) -> Vec<Line> {
        let mut known = std::collections::BTreeMap::new();
        for (output, cubes) in self.on.iter().enumerate() {
            for cube in cubes {
                let outputs: &mut Vec<usize> = known.entry(cube).or_default();
                if outputs.last() != Some(&output) {
                    outputs.push(output);
                }
            }
        }
        let lines = known.into_iter().map(|(cube, outputs)| Line {
            cube: unpacked(cube),
            outputs,
        });
        lines.collect()
    }

    /// As few products as the three steps come to from these.
    pub(super) fn reduced(&mut self, lines: &[Line]) -> Vec<Line> {
        let mut products: Vec<Product> = lines.iter().map(|line| self.product(line)).collect();
        products = self.expand(products);
        self.irredundant(&mut products);
        let (mut best, mut next) = (products.clone(), products);
        let cost = |products: &[Product]| {
            let sizes = products.iter().map(Product::size);
            (products.len(), sizes.sum::<usize>())
        };
        let mut vain = 0;
        while vain < VAIN && self.work > 0 {
            self.reduce(&mut next, vain);
            next = self.expand(next);
            self.irredundant(&mut next);
            if cost(&next) < cost(&best) {
                best.clone_from(&next);
                vain = 0;
            } else {
                vain += 1;
            }
        }
        // The steps may have ended where their work did.
        self.work = self.work.max(TIDY);
        self.irredundant(&mut best);
        let lines = best.iter().map(|product| Line {
            cube: unpacked(&product.cube),
            outputs: (0..self.functions.len())
                .filter(|output| product.serves(*output))
                .collect(),
        });
        lines.collect()
    }

    fn product(&self, line: &Line) -> Product {
        let outputs = 0..self.functions.len();
        Product {
            cube: Packed::of(self.inputs, &line.cube),
            outputs: outputs
                .map(|output| line.outputs.contains(&output))
                .collect(),
        }
    }

    /// Whether a product is 0 nowhere.
    fn is_implied(&mut self, product: &Product) -> bool {
        let cube = unpacked(&product.cube);
        let functions = self.functions;
        let served = functions.iter().enumerate();
        let mut served = served.filter(|(output, _)| product.serves(*output));
        served.all(|(_, function)| {
            let words = (1 + cube.literals().len()) * function.columns.rows().div_ceil(64);
            self.work = self.work.saturating_sub(words as u64 / 4);
            function.columns.cube_meets(&cube, &function.off).is_empty()
        })
    }

    /// Each product becomes a prime, towards others that it then contains.
    fn expand(&mut self, mut open: Vec<Product>) -> Vec<Product> {
        open.sort_by_key(|product| Reverse(product.size()));
        let mut primes: Vec<Product> = Vec::new();
        while !open.is_empty() {
            let product = open.remove(0);
            if primes.iter().any(|prime| prime.contains(&product)) {
                continue;
            }
            let prime = self.towards(product, &open);
            let prime = self.raised(prime, &open);
            open.retain(|other| !prime.contains(other));
            primes.retain(|other| !prime.contains(other));
            primes.push(prime);
        }
        primes
    }

    /// A product that contains as many of the others as can be.
    fn towards(&mut self, mut product: Product, others: &[Product]) -> Product {
        loop {
            let outside = others.iter().enumerate();
            let outside = outside.filter(|(_, other)| !product.contains(other));
            let mut near: Vec<(usize, usize)> = outside
                .map(|(at, other)| (product.cube.lost(&other.cube), at))
                .collect();
            self.work = self.work.saturating_sub(others.len() as u64);
            if near.len() > NEAR {
                near.select_nth_unstable(NEAR);
                near.truncate(NEAR);
            }
            near.sort_unstable();
            let near = near.into_iter().filter_map(|(_, at)| others.get(at));
            let mut wider: Vec<Product> = near.map(|other| product.supercube(other)).collect();
            wider.dedup();
            wider.retain(|wider| self.is_implied(wider));
            let within = |wider: &Product| others.iter().filter(|o| wider.contains(o)).count();
            let best = wider.into_iter().map(|wider| (within(&wider), wider));
            match best.reduce(|best, next| if next.0 > best.0 { next } else { best }) {
                Some((_, wider)) if self.work > 0 => product = wider,
                _ => return product,
            }
        }
    }

    /// A product without literals that it can do without, those first that fewest others agree with, and for all outputs
    /// that it may serve.
    fn raised(&mut self, mut product: Product, others: &[Product]) -> Product {
        let agree = |(atom, value): &(usize, bool)| {
            let cubes = others.iter().map(|other| other.cube.get(*atom));
            cubes.filter(|other| *other == Some(*value)).count()
        };
        let mut literals: Vec<(usize, bool)> = product.cube.fixed().collect();
        literals.sort_by_cached_key(agree);
        self.work = self
            .work
            .saturating_sub((literals.len() * others.len()) as u64);
        for (atom, value) in literals {
            product.cube.set(atom, None);
            if !self.is_implied(&product) {
                product.cube.set(atom, Some(value));
            }
        }
        for output in 0..self.functions.len() {
            if product.serves(output) {
                continue;
            }
            let mut alone = product.clone();
            alone.outputs.fill(false);
            let more = |product: &mut Product| {
                if let Some(serves) = product.outputs.get_mut(output) {
                    *serves = true;
                }
            };
            more(&mut alone);
            let is_of_use = self
                .on
                .get(output)
                .is_some_and(|on| on.iter().any(|cube| cube.meets(&alone.cube)));
            if is_of_use && self.is_implied(&alone) {
                more(&mut product);
            }
        }
        product
    }

    /// What an output needs of a product beside the others: its ON cubes and these.
    fn beside<'p>(
        on: &'p [Packed],
        products: &'p [Product],
        at: usize,
        output: usize,
    ) -> (Vec<&'p Packed>, Vec<&'p Packed>) {
        let others = products.iter().enumerate();
        let others = others.filter(|(other, p)| *other != at && p.serves(output));
        let others = others.map(|(_, product)| &product.cube);
        (on.iter().collect(), others.collect())
    }

    /// The smallest cube around what of an output's ON cubes only one product contains.
    fn needed(&mut self, products: &[Product], at: usize, output: usize) -> Option<Packed> {
        let (on, others) = Self::beside(self.on.get(output)?, products, at, output);
        rest(&products.get(at)?.cube, &on, &others, &mut self.work)
    }

    /// Whether only one product contains some of an output's ON cubes.
    fn is_needed(&mut self, products: &[Product], at: usize, output: usize) -> bool {
        let (Some(on), Some(product)) = (self.on.get(output), products.get(at)) else {
            return false;
        };
        let (on, others) = Self::beside(on, products, at, output);
        is_left(&product.cube, &on, &others, &mut self.work)
    }

    /// Drops the outputs of products that others make superfluous, and products without outputs: large ones first.
    fn irredundant(&mut self, products: &mut Vec<Product>) {
        products.sort_by_key(|product| Reverse(product.size()));
        for at in 0..products.len() {
            if self.work == 0 {
                break;
            }
            for output in 0..self.functions.len() {
                let serves = products.get(at).is_some_and(|p| p.serves(output));
                if serves && !self.is_needed(products, at, output) {
                    let product = products.get_mut(at);
                    if let Some(serves) = product.and_then(|p| p.outputs.get_mut(output)) {
                        *serves = false;
                    }
                }
            }
        }
        products.retain(|product| product.outputs.contains(&true));
    }

    /// Each product becomes the smallest that the others need it to be: small ones first, or large ones.
    fn reduce(&mut self, products: &mut [Product], turn: usize) {
        products.sort_by_key(Product::size);
        if turn % 2 == 1 {
            products.reverse();
        }
        for at in 0..products.len() {
            let needed = self.needed_of(products, at);
            if let (Some(needed), Some(product)) = (needed, products.get_mut(at)) {
                *product = needed;
            }
        }
    }

    /// The smallest product around what the outputs need of one beside the others.
    fn needed_of(&mut self, products: &[Product], at: usize) -> Option<Product> {
        let mut known: Option<Packed> = None;
        let mut outputs = Vec::new();
        for output in 0..self.functions.len() {
            let serves = products.get(at).is_some_and(|p| p.serves(output));
            let alone = serves.then(|| self.needed(products, at, output)).flatten();
            outputs.push(alone.is_some());
            known = match (known, alone) {
                (Some(a), Some(b)) => Some(a.supercube(&b)),
                (a, b) => a.or(b),
            };
        }
        known.map(|cube| Product { cube, outputs })
    }
}

fn unpacked(cube: &Packed) -> Cube {
    Cube::new(
        cube.fixed()
            .map(|(atom, positive)| Literal { atom, positive }),
    )
}
