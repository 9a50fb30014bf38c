//! The machine: a file of registers and one loop.

use super::code::{Code, Instruction, Op, Register};
use super::layout::Fixed;
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
    /// Whether no wall stands between the robot's centre and a fixed point, and up to which value of
    /// [`Fixed::Path`](super::Fixed::Path) that is so. `first` is the first of the point's two registers.
    fn sight(&mut self, _first: Register, x: f64, y: f64) -> (bool, f64) {
        (self.visible(x, y), f64::NEG_INFINITY)
    }
    /// Reads an echo source, see [`Reading::parts`]; what was read before is left if it still holds.
    fn look(&mut self, source: u16, parts: &mut [f64; 4]);
    /// Whether the robot's centre is in a place.
    fn inside(&mut self, place: u16) -> bool;
    /// The random numbers.
    fn random(&mut self) -> &mut Random;
    /// An event has happened.
    fn fire(&mut self, event: u16);
    /// The atoms that hold, a bit each.
    fn atoms(&mut self) -> &mut u128;
}

impl Reading {
    /// What the registers hold of it: the distance, the vector, whether it was seen.
    #[inline]
    pub fn parts(self) -> [f64; 4] {
        let [x, y] = self.toward;
        [self.distance, x, y, truth(self.seen)]
    }
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
    if code.instructions().is_empty() {
        return 0;
    }
    #[cfg(feature = "native")]
    if let Some(native) = code.native.get() {
        return native.run(&mut r.0, host);
    }
    interpret(code.instructions(), r, host)
}

#[inline(never)]
fn interpret<H: Host>(code: &[Instruction], r: &mut Registers, host: &mut H) -> u16 {
    let mut pc = 0;
    while let Some(&Instruction { op, dst, a, b }) = code.get(pc) {
        pc += 1;
        let jump = |taken: bool, pc: usize| if taken { dst as usize } else { pc };
        match op {
            Op::Move => r.set(dst, r.get(a)),
            Op::Direction => r.set(dst, direction(r.get(a), r.get(b))),
            Op::SquareSum => {
                let (x, y) = (r.get(a), r.get(b));
                r.set(dst, x * x + y * y);
            }
            Op::WrapSub => r.set(dst, wrap_sub(r.get(a), r.get(b))),
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
            Op::Sees => {
                let holds = r.get(Fixed::Path.register()) < r.get(dst);
                if !holds {
                    let (seen, until) = host.sight(dst, r.get(a), r.get(b));
                    r.set(dst, until);
                    r.set(dst + 1, truth(seen));
                }
            }
            Op::Nearer | Op::Within => {
                let bound = r.get(b);
                let near = if r.get(Fixed::Clear.register()) > bound {
                    false
                } else {
                    look(r, host, a, NEAREST_WALL);
                    let distance = r.get(a);
                    match op {
                        Op::Nearer => distance < bound,
                        _ => distance <= bound,
                    }
                };
                r.set(dst, truth(near));
            }
            Op::Look => look(r, host, dst, a),
            Op::Inside => r.set(dst, truth(host.inside(a))),
            Op::Uniform => r.set(dst, uniform(host, r.get(a), r.get(b))),
            Op::Normal => r.set(dst, normal(host, r.get(a), r.get(b))),
            Op::Chance => r.set(dst, chance(host, r.get(a))),
            Op::Pick => r.set(dst, pick(host, r.get(a))),
            Op::Fire => host.fire(a),
            Op::Atom => *host.atoms() |= u128::from(r.get(a) != 0.0) << (dst & 127),
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

/// The number of the nearest wall among the echo sources.
pub(super) const NEAREST_WALL: u16 = 0;

/// Reads an echo source into the four registers from the first.
fn look<H: Host>(r: &mut Registers, host: &mut H, first: Register, source: u16) {
    let mut parts = [first, first + 1, first + 2, first + 3].map(|register| r.get(register));
    host.look(source, &mut parts);
    for (register, part) in (first..).zip(parts) {
        r.set(register, part);
    }
}

#[inline(always)]
pub(super) fn truth(holds: bool) -> f64 {
    f64::from(u8::from(holds))
}

/// The direction of a vector, in [−π, π).
pub(super) fn direction(y: f64, x: f64) -> f64 {
    let angle = math::atan2(y, x);
    if angle < PI { angle } else { -PI }
}

fn wrap_sub(a: f64, b: f64) -> f64 {
    math::wrap(a - b)
}

pub(super) fn uniform(host: &mut (impl Host + ?Sized), from: f64, to: f64) -> f64 {
    host.random().uniform(from, to)
}

pub(super) fn normal(host: &mut (impl Host + ?Sized), mean: f64, deviation: f64) -> f64 {
    mean + deviation * host.random().gaussian()
}

pub(super) fn chance(host: &mut (impl Host + ?Sized), probability: f64) -> f64 {
    truth(host.random().chance(probability))
}

pub(super) fn pick(host: &mut (impl Host + ?Sized), count: f64) -> f64 {
    host.random().below(count as u64) as f64
}
