//! The machine: a file of registers and one loop.

use super::code::{Code, Instruction, Op, Register};
use crate::math;
use crate::random::Random;
use std::f64::consts::PI;

/// How many registers there are; a power of two, so that a masked index needs no check.
pub const REGISTERS: usize = 4096;

/// The registers. Truth values are 0 and 1.
#[derive(Clone, Debug)]
pub struct Registers(Box<[f64; REGISTERS]>);

impl Default for Registers {
    fn default() -> Self {
        Self(Box::new([0.0; REGISTERS]))
    }
}

/// What a sensor gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// The distance in metres.
    pub distance: f64,
    /// A vector in the direction of the echo, of any length.
    pub toward: [f64; 2],
    /// Whether there is an echo.
    pub seen: bool,
}

/// The world, as far as expressions ask it.
pub trait Host {
    /// Whether no wall stands between the robot's centre and a point.
    fn visible(&mut self, x: f64, y: f64) -> bool;
    /// A reading of an echo source; `None` if the one in the registers still holds.
    fn look(&mut self, source: u16) -> Option<Reading>;
    /// Whether the robot's centre is in a place.
    fn inside(&mut self, place: u16) -> bool;
    /// The random numbers.
    fn random(&mut self) -> &mut Random;
    /// An event has happened.
    fn fire(&mut self, event: u16);
    /// An atom has this value.
    fn atom(&mut self, bit: u16, holds: bool);
}

#[allow(
    clippy::indexing_slicing,
    reason = "a masked index is always within the array, so no check is compiled"
)]
impl Registers {
    /// The value of a register.
    #[inline(always)]
    pub fn get(&self, register: Register) -> f64 {
        self.0[register as usize & (REGISTERS - 1)]
    }

    /// Sets a register.
    #[inline(always)]
    pub fn set(&mut self, register: Register, value: f64) {
        self.0[register as usize & (REGISTERS - 1)] = value;
    }
}

/// Runs a piece of code. Its answer is that of the `Exit` it meets, 0 if it meets none.
///
/// Arithmetic is that of IEEE 754. A comparison with NaN is false, so a jump on it is not taken, and one on its
/// negation is.
#[inline]
pub fn run<H: Host>(code: &Code, r: &mut Registers, host: &mut H) -> u16 {
    let code: &[Instruction] = &code.0;
    let mut pc = 0;
    while let Some(&Instruction { op, dst, a, b }) = code.get(pc) {
        pc += 1;
        let jump = |taken: bool, pc: usize| if taken { dst as usize } else { pc };
        match op {
            Op::Move => r.set(dst, r.get(a)),
            Op::Direction => {
                let angle = math::atan2(r.get(a), r.get(b));
                r.set(dst, if angle < PI { angle } else { -PI });
            }
            Op::SquareSum => {
                let (x, y) = (r.get(a), r.get(b));
                r.set(dst, x * x + y * y);
            }
            Op::WrapSub => r.set(dst, math::wrap(r.get(a) - r.get(b))),
            Op::Clamp => {
                let (x, limit) = (r.get(a), r.get(b));
                let x = if -limit > x { -limit } else { x };
                r.set(dst, if limit < x { limit } else { x });
            }
            Op::Jump => pc = dst as usize,
            Op::JumpIf => pc = jump(r.get(a) != 0.0, pc),
            Op::JumpUnless => pc = jump(r.get(a) == 0.0, pc),
            Op::JumpEq => pc = jump(r.get(a) == r.get(b), pc),
            Op::JumpNe => pc = jump(r.get(a) != r.get(b), pc),
            Op::JumpLt => pc = jump(r.get(a) < r.get(b), pc),
            Op::JumpLe => pc = jump(r.get(a) <= r.get(b), pc),
            Op::JumpUnlessLt => {
                pc = if r.get(a) < r.get(b) {
                    pc
                } else {
                    dst as usize
                }
            }
            Op::JumpUnlessLe => {
                pc = if r.get(a) <= r.get(b) {
                    pc
                } else {
                    dst as usize
                }
            }
            Op::Visible => r.set(dst, truth(host.visible(r.get(a), r.get(b)))),
            Op::Look => {
                if let Some(reading) = host.look(a) {
                    r.set(dst, reading.distance);
                    r.set(dst + 1, reading.toward[0]);
                    r.set(dst + 2, reading.toward[1]);
                    r.set(dst + 3, truth(reading.seen));
                }
            }
            Op::Inside => r.set(dst, truth(host.inside(a))),
            Op::Uniform => {
                let value = host.random().uniform(r.get(a), r.get(b));
                r.set(dst, value);
            }
            Op::Normal => {
                let value = r.get(a) + r.get(b) * host.random().gaussian();
                r.set(dst, value);
            }
            Op::Chance => {
                let value = host.random().chance(r.get(a));
                r.set(dst, truth(value));
            }
            Op::Pick => {
                let value = host.random().below(r.get(a) as u64);
                r.set(dst, value as f64);
            }
            Op::Fire => host.fire(a),
            Op::Atom => host.atom(dst, r.get(a) != 0.0),
            Op::Exit => return a,
            // The loads stay inside, so that this is one jump table with the arms above.
            operator => {
                if let Some(value) = operator.apply(|| r.get(a), || r.get(b)) {
                    r.set(dst, value);
                }
            }
        }
    }
    0
}

#[inline(always)]
fn truth(holds: bool) -> f64 {
    f64::from(u8::from(holds))
}
