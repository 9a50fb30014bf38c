//! An expression of its own, such as a learner's `rate`.

use super::code::{Code, Register};
use super::compiler::{Compiler, TooLarge};
use super::layout::{Fixed, Layout};
use super::machine::{Nowhere, Registers, run};
use crate::ir::{ExprId, Program};
use crate::random::Random;

/// A function of `visits` and `progress`, compiled.
#[derive(Clone, Debug)]
pub struct Formula {
    code: Code,
    registers: Registers,
    host: Nowhere,
}

/// Where its value goes; no formula commands wheels.
const RESULT: Register = Fixed::Speed as Register;

impl Formula {
    /// Compiles an expression of `visits` and `progress`.
    ///
    /// # Errors
    /// If it does not fit the machine.
    pub fn compile(program: &Program, id: ExprId) -> Result<Self, TooLarge> {
        let mut layout = Layout::new(program)?;
        let mut compiler = Compiler::new(&program.pool, &mut layout, None);
        compiler.assign(RESULT, id)?;
        let code = compiler.finish()?;
        Ok(Self {
            code,
            registers: layout.registers(),
            host: Nowhere(Random::new(0, 0, 0)),
        })
    }

    /// Its value after so many visits and at this progress, from 0 to 1.
    pub fn value(&mut self, visits: f64, progress: f64) -> f64 {
        self.registers.set(Fixed::Visits.register(), visits);
        self.registers.set(Fixed::Progress.register(), progress);
        run(&self.code, &mut self.registers, &mut self.host);
        self.registers.get(RESULT)
    }
}
