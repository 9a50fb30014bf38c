//! From register code to the machine code of the processor, by way of Cranelift's intermediate representation.
//!
//! A register that a piece of code has written or read is kept as a value as long as every way to the instruction goes
//! through that; memory is always up to date, so what is called from within sees it. Jumps go forwards only.

use super::code::{Code, Instruction, Op, Register};
use super::layout::Fixed;
use super::machine::{NEAREST_WALL, REGISTERS};
use super::native::{Callee, callee};
use cranelift::codegen::ir::Function;
use cranelift::prelude::*;
use rustc_hash::FxHashMap;
use std::f64::consts::PI;

/// What the registers hold, as far as that is known.
type Known = FxHashMap<Register, Held>;

/// The value of a register.
#[derive(Clone, Copy, PartialEq)]
enum Held {
    Number(Value),
    /// A truth value as a condition and as a number.
    Truth(Value, Value),
}

impl Held {
    fn number(self) -> Value {
        match self {
            Held::Number(value) | Held::Truth(_, value) => value,
        }
    }
}

struct Translator<'f> {
    builder: FunctionBuilder<'f>,
    /// How functions are called.
    convention: isa::CallConv,
    /// The type of addresses.
    pointer: Type,
    registers: Value,
    context: Value,
    known: Known,
    /// What the code may jump to, with what is known on every way there that was seen so far.
    targets: FxHashMap<usize, (Block, Option<Known>)>,
}

/// Fills a function of two pointers, to the registers and to a [`Context`](super::native::Context), that does what a piece
/// of code does; its result is the answer. False if the code jumps backwards.
pub(super) fn translate(
    code: &Code,
    function: &mut Function,
    memory: &mut FunctionBuilderContext,
    pointer: Type,
) -> bool {
    let instructions = code.instructions();
    let mut builder = FunctionBuilder::new(function, memory);
    let entry = builder.create_block();
    builder.append_block_params_for_function_params(entry);
    builder.switch_to_block(entry);
    let &[registers, context] = builder.block_params(entry) else {
        return false;
    };
    let mut targets = FxHashMap::default();
    for (at, instruction) in instructions.iter().enumerate() {
        if instruction.op.jumps() {
            let to = usize::from(instruction.dst);
            if to <= at {
                return false;
            }
            let target = || (builder.create_block(), None);
            targets
                .entry(to.min(instructions.len()))
                .or_insert_with(target);
        }
    }
    let mut translator = Translator {
        convention: builder.func.signature.call_conv,
        builder,
        pointer,
        registers,
        context,
        known: Known::default(),
        targets,
    };
    translator.all(instructions);
    translator.builder.seal_all_blocks();
    translator.builder.finalize();
    true
}

impl Translator<'_> {
    fn all(&mut self, instructions: &[Instruction]) {
        let mut runs = true;
        for (at, instruction) in instructions.iter().enumerate() {
            runs |= self.arrive(at, runs);
            if runs {
                runs = self.one(instruction);
            }
        }
        if self.arrive(instructions.len(), runs) || runs {
            self.answer(0);
        }
    }

    /// Goes on in the block that is jumped to from before, if there is one here. `runs`: the instruction before leads here,
    /// too.
    fn arrive(&mut self, at: usize, runs: bool) -> bool {
        if runs {
            self.meet(at);
        }
        let Some((block, known)) = self.targets.remove(&at) else {
            return false;
        };
        if runs {
            self.builder.ins().jump(block, &[]);
        }
        self.builder.switch_to_block(block);
        self.known = known.unwrap_or_default();
        true
    }

    /// The block of a jump's target. What is known there is what is known on every way there.
    fn meet(&mut self, target: usize) -> Option<Block> {
        let (block, there) = self.targets.get_mut(&target)?;
        match there {
            Some(there) => there.retain(|register, held| self.known.get(register) == Some(held)),
            None => *there = Some(self.known.clone()),
        }
        Some(*block)
    }

    /// Whether the next instruction may run after this one.
    fn one(&mut self, &Instruction { op, dst, a, b }: &Instruction) -> bool {
        match op {
            Op::Move => {
                let held = self.held(a);
                self.set(dst, held);
            }
            Op::Neg | Op::Abs | Op::Sqrt => {
                let x = self.get(a);
                let ins = self.builder.ins();
                let value = match op {
                    Op::Neg => ins.fneg(x),
                    Op::Abs => ins.fabs(x),
                    _ => ins.sqrt(x),
                };
                self.set(dst, Held::Number(value));
            }
            Op::Add | Op::Sub | Op::Mul | Op::Div => {
                let (x, y) = (self.get(a), self.get(b));
                let ins = self.builder.ins();
                let value = match op {
                    Op::Add => ins.fadd(x, y),
                    Op::Sub => ins.fsub(x, y),
                    Op::Mul => ins.fmul(x, y),
                    _ => ins.fdiv(x, y),
                };
                self.set(dst, Held::Number(value));
            }
            Op::Min | Op::Max => {
                let (x, y) = (self.get(a), self.get(b));
                let value = self.outermost(x, y, op == Op::Min);
                self.set(dst, Held::Number(value));
            }
            Op::Clamp => {
                let (x, limit) = (self.get(a), self.get(b));
                let low = self.builder.ins().fneg(limit);
                let raised = self.outermost(x, low, false);
                let value = self.outermost(raised, limit, true);
                self.set(dst, Held::Number(value));
            }
            Op::SquareSum => {
                let (x, y) = (self.get(a), self.get(b));
                let x = self.builder.ins().fmul(x, x);
                let y = self.builder.ins().fmul(y, y);
                let value = self.builder.ins().fadd(x, y);
                self.set(dst, Held::Number(value));
            }
            Op::Eq => self.compared(dst, FloatCC::Equal, a, b),
            Op::Ne => self.compared(dst, FloatCC::NotEqual, a, b),
            Op::Lt => self.compared(dst, FloatCC::LessThan, a, b),
            Op::Le => self.compared(dst, FloatCC::LessThanOrEqual, a, b),
            Op::Not => {
                let x = self.is_true(a);
                let holds = self.builder.ins().icmp_imm(IntCC::Equal, x, 0);
                self.truth(dst, holds);
            }
            Op::And | Op::Or => {
                let (x, y) = (self.is_true(a), self.is_true(b));
                let ins = self.builder.ins();
                let holds = match op {
                    Op::And => ins.band(x, y),
                    _ => ins.bor(x, y),
                };
                self.truth(dst, holds);
            }
            Op::Jump => {
                if let Some(target) = self.meet(usize::from(dst)) {
                    self.builder.ins().jump(target, &[]);
                }
                return false;
            }
            Op::JumpIf => self.branch(true, dst, |it| it.is_true(a)),
            Op::JumpUnless => self.branch(false, dst, |it| it.is_true(a)),
            Op::JumpEq => self.branch(true, dst, |it| it.compare(FloatCC::Equal, a, b)),
            Op::JumpNe => self.branch(true, dst, |it| it.compare(FloatCC::NotEqual, a, b)),
            Op::JumpLt => self.branch(true, dst, |it| it.compare(FloatCC::LessThan, a, b)),
            Op::JumpLe => self.branch(true, dst, |it| it.compare(FloatCC::LessThanOrEqual, a, b)),
            Op::JumpUnlessLt => self.branch(false, dst, |it| it.compare(FloatCC::LessThan, a, b)),
            Op::JumpUnlessLe => {
                self.branch(false, dst, |it| it.compare(FloatCC::LessThanOrEqual, a, b));
            }
            Op::Wrap => {
                let angle = self.get(a);
                self.wrap(dst, angle);
            }
            Op::WrapSub => {
                let (x, y) = (self.get(a), self.get(b));
                let angle = self.builder.ins().fsub(x, y);
                self.wrap(dst, angle);
            }
            Op::Sees => self.sees(dst, a, b),
            Op::Nearer => self.near(FloatCC::LessThan, dst, a, b),
            Op::Within => self.near(FloatCC::LessThanOrEqual, dst, a, b),
            Op::Atom => self.atom(dst, a),
            Op::Exit => {
                self.answer(a);
                return false;
            }
            called => {
                if let Some(callee) = callee(called) {
                    self.call(callee, dst, a, b);
                }
            }
        }
        true
    }

    /// Where a register is, from the address of the first.
    fn offset(register: Register) -> i32 {
        8 * i32::from(register & (REGISTERS as Register - 1))
    }

    fn held(&mut self, register: Register) -> Held {
        if let Some(&held) = self.known.get(&register) {
            return held;
        }
        let held = Held::Number(self.load(register));
        self.known.insert(register, held);
        held
    }

    fn get(&mut self, register: Register) -> Value {
        self.held(register).number()
    }

    fn set(&mut self, register: Register, held: Held) {
        let (flags, offset) = (MemFlags::trusted(), Self::offset(register));
        let ins = self.builder.ins();
        ins.store(flags, held.number(), self.registers, offset);
        self.known.insert(register, held);
    }

    fn truth(&mut self, register: Register, holds: Value) {
        let yes = self.builder.ins().f64const(1.0);
        let no = self.builder.ins().f64const(0.0);
        let number = self.builder.ins().select(holds, yes, no);
        self.set(register, Held::Truth(holds, number));
    }

    /// Whether a register is not zero; one that is not a number is not.
    fn is_true(&mut self, register: Register) -> Value {
        match self.held(register) {
            Held::Truth(holds, _) => holds,
            Held::Number(value) => {
                let zero = self.builder.ins().f64const(0.0);
                self.builder.ins().fcmp(FloatCC::NotEqual, value, zero)
            }
        }
    }

    fn compare(&mut self, how: FloatCC, a: Register, b: Register) -> Value {
        let (x, y) = (self.get(a), self.get(b));
        self.builder.ins().fcmp(how, x, y)
    }

    fn compared(&mut self, dst: Register, how: FloatCC, a: Register, b: Register) {
        let holds = self.compare(how, a, b);
        self.truth(dst, holds);
    }

    /// The lesser of two numbers, or the greater: the first unless the second is beyond it.
    fn outermost(&mut self, x: Value, y: Value, least: bool) -> Value {
        let beyond = match least {
            true => FloatCC::LessThan,
            false => FloatCC::GreaterThan,
        };
        let beyond = self.builder.ins().fcmp(beyond, y, x);
        self.builder.ins().select(beyond, y, x)
    }

    /// Jumps to `to` where the condition is `wanted`.
    fn branch(&mut self, wanted: bool, to: Register, condition: impl FnOnce(&mut Self) -> Value) {
        let holds = condition(self);
        let Some(target) = self.meet(usize::from(to)) else {
            return;
        };
        let next = self.builder.create_block();
        let (then, otherwise) = match wanted {
            true => (target, next),
            false => (next, target),
        };
        self.builder.ins().brif(holds, then, &[], otherwise, &[]);
        self.builder.switch_to_block(next);
    }

    fn atom(&mut self, bit: u16, register: Register) {
        let holds = self.is_true(register);
        let word = self.builder.ins().uextend(types::I64, holds);
        let word = self.builder.ins().ishl_imm(word, i64::from(bit & 63));
        let (flags, offset) = (MemFlags::trusted(), i32::from(bit & 64) / 8);
        let ins = self.builder.ins();
        let before = ins.load(types::I64, flags, self.context, offset);
        let after = self.builder.ins().bor(before, word);
        self.builder.ins().store(flags, after, self.context, offset);
    }

    fn answer(&mut self, answer: u16) {
        let answer = self.builder.ins().iconst(types::I32, i64::from(answer));
        self.builder.ins().return_(&[answer]);
    }

    /// The same direction in [−π, π): nearly always the angle itself.
    fn wrap(&mut self, dst: Register, angle: Value) {
        let Some(callee) = callee(Op::Wrap) else {
            return;
        };
        let low = self.builder.ins().f64const(-PI);
        let high = self.builder.ins().f64const(PI);
        let above = FloatCC::GreaterThanOrEqual;
        let above = self.builder.ins().fcmp(above, angle, low);
        let below = self.builder.ins().fcmp(FloatCC::LessThan, angle, high);
        let inside = self.builder.ins().band(above, below);
        let done = self.unless(inside, types::F64, angle);
        if let Some(wrapped) = self.invoke(callee, &[angle], true) {
            self.builder.ins().jump(done, &[wrapped.into()]);
        }
        self.builder.switch_to_block(done);
        if let Some(&wrapped) = self.builder.block_params(done).first() {
            self.set(dst, Held::Number(wrapped));
        }
    }

    /// Whether a fixed point is in sight: what is known holds up to a point of the robot's way.
    fn sees(&mut self, first: Register, x: Register, y: Register) {
        let Some(callee) = callee(Op::Sees) else {
            return;
        };
        let (path, until) = (self.get(Fixed::Path.register()), self.get(first));
        let (x_of, y_of) = (self.get(x), self.get(y));
        let holds = self.builder.ins().fcmp(FloatCC::LessThan, path, until);
        let seen = self.load(first + 1);
        let done = self.unless(holds, types::F64, seen);
        let into = self.address(first, 2);
        let number = self.builder.ins().iconst(types::I32, i64::from(first));
        let arguments = [self.context, number, x_of, y_of, into];
        self.invoke(callee, &arguments, false);
        let seen = self.load(first + 1);
        self.builder.ins().jump(done, &[seen.into()]);
        self.builder.switch_to_block(done);
        self.known.remove(&first);
        if let Some(&seen) = self.builder.block_params(done).first() {
            self.known.insert(first + 1, Held::Number(seen));
        }
    }

    /// Whether the nearest wall is nearer than a bound, or as near: it is looked at only where it may be.
    fn near(&mut self, how: FloatCC, dst: Register, first: Register, bound: Register) {
        let Some(callee) = callee(Op::Look) else {
            return;
        };
        let (clear, bound) = (self.get(Fixed::Clear.register()), self.get(bound));
        let far = self.builder.ins().fcmp(FloatCC::GreaterThan, clear, bound);
        let no = self.builder.ins().iconst(types::I8, 0);
        let done = self.unless(far, types::I8, no);
        let into = self.address(first, 4);
        let nearest = self
            .builder
            .ins()
            .iconst(types::I32, i64::from(NEAREST_WALL));
        let arguments = [self.context, nearest, into];
        self.invoke(callee, &arguments, false);
        let distance = self.load(first);
        let near = self.builder.ins().fcmp(how, distance, bound);
        self.builder.ins().jump(done, &[near.into()]);
        self.builder.switch_to_block(done);
        self.forget_echo(first);
        if let Some(&near) = self.builder.block_params(done).first() {
            self.truth(dst, near);
        }
    }

    /// A block that is gone to at once, with a value, where a condition holds. What comes next is done where it does not, which is
    /// rare, and has to go there, too.
    fn unless(&mut self, holds: Value, of: Type, value: Value) -> Block {
        let (rare, done) = (self.builder.create_block(), self.builder.create_block());
        self.builder.append_block_param(done, of);
        self.builder.set_cold_block(rare);
        self.builder
            .ins()
            .brif(holds, done, &[value.into()], rare, &[]);
        self.builder.switch_to_block(rare);
        done
    }

    /// The value of a register in memory.
    fn load(&mut self, register: Register) -> Value {
        let (flags, offset) = (MemFlags::trusted(), Self::offset(register));
        let ins = self.builder.ins();
        ins.load(types::F64, flags, self.registers, offset)
    }

    /// Where so many registers are; all of them are registers, whatever the first is.
    fn address(&mut self, first: Register, count: u16) -> Value {
        let offset = i64::from(Self::offset(first.min(REGISTERS as Register - count)));
        self.builder.ins().iadd_imm(self.registers, offset)
    }

    /// The registers of an echo source may have changed.
    fn forget_echo(&mut self, first: Register) {
        for register in first..=first.saturating_add(3) {
            self.known.remove(&register);
        }
    }

    /// Calls a function; `gives`: with a number as its result.
    fn invoke(&mut self, callee: Callee, arguments: &[Value], gives: bool) -> Option<Value> {
        let mut signature = Signature::new(self.convention);
        for argument in arguments {
            let of = self.builder.func.dfg.value_type(*argument);
            signature.params.push(AbiParam::new(of));
        }
        if gives {
            signature.returns.push(AbiParam::new(types::F64));
        }
        let signature = self.builder.import_signature(signature);
        let ins = self.builder.ins();
        let address = ins.iconst(self.pointer, callee.address() as i64);
        let ins = self.builder.ins();
        let call = ins.call_indirect(signature, address, arguments);
        self.builder.inst_results(call).first().copied()
    }

    /// Calls what does the rest of the instructions.
    fn call(&mut self, callee: Callee, dst: Register, a: Register, b: Register) {
        let index =
            |it: &mut Self, index: u16| it.builder.ins().iconst(types::I32, i64::from(index));
        let arguments = match callee {
            Callee::Unary(_) => vec![self.get(a)],
            Callee::Binary(_) => vec![self.get(a), self.get(b)],
            Callee::Asked(_) => vec![self.context, self.get(a), self.get(b)],
            Callee::Numbered(_) | Callee::Told(_) => vec![self.context, index(self, a)],
            Callee::Look(_) => {
                let into = self.address(dst, 4);
                vec![self.context, index(self, a), into]
            }
            Callee::Sees(_) => return,
        };
        let gives = !matches!(callee, Callee::Told(_) | Callee::Look(_));
        if let Some(value) = self.invoke(callee, &arguments, gives) {
            self.set(dst, Held::Number(value));
        } else if let Callee::Look(_) = callee {
            self.forget_echo(dst);
        }
    }
}
