//! Code that runs often, as machine code of the processor.
//!
//! [`run`](super::run) interprets a piece of code until it has been compiled; both do the same, bit by bit.

#![allow(
    unsafe_code,
    reason = "compiled code is called through its address; no other file calls any"
)]

use super::code::{Code, Op};
use super::machine::{self, Host, REGISTERS};
use super::translate::translate;
use crate::ir::expr::{Binary, Unary};
use crate::ir::operator::operators;
use cranelift::jit::{JITBuilder, JITModule};
use cranelift::module::{Module, default_libcall_names};
use cranelift::prelude::*;
use std::fmt;
use std::mem::ManuallyDrop;
use std::sync::Arc;

/// What compiled code asks and tells.
#[repr(C)]
pub(super) struct Context<'h> {
    /// The atoms that hold, in two words: compiled code sets their bits.
    atoms: [u64; 2],
    host: &'h mut (dyn Host + 'h),
}

/// A piece of code, compiled.
#[derive(Clone)]
pub(super) struct Native {
    entry: Entry,
    /// Where the machine code is.
    _pages: Arc<Pages>,
}

/// Of the address of the registers and of a [`Context`] it makes the answer.
type Entry = unsafe extern "C" fn(*mut f64, *mut Context<'_>) -> u32;

/// The memory that holds machine code, until nothing needs it any more.
struct Pages(ManuallyDrop<JITModule>);

// SAFETY: once `compile` has made it, nothing reads or changes the module until it is dropped.
unsafe impl Send for Pages {}
// SAFETY: as above.
unsafe impl Sync for Pages {}

impl Drop for Pages {
    fn drop(&mut self) {
        // SAFETY: the module is taken once, here; every `Native` that has an address in it has kept it alive, and none is
        // left.
        unsafe { ManuallyDrop::take(&mut self.0).free_memory() }
    }
}

impl fmt::Debug for Native {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Native")
    }
}

impl Native {
    /// Runs it; see [`run`](super::run).
    #[inline]
    pub(super) fn run<H: Host>(&self, registers: &mut [f64; REGISTERS], host: &mut H) -> u16 {
        let mut context = Context {
            atoms: [0; 2],
            host: &mut *host,
        };
        // SAFETY: the entry is a function of this type, in memory that is kept as long as `self`. It reads and writes
        // registers below `REGISTERS` and the context, and calls functions that borrow them no longer than the call.
        let answer = unsafe { (self.entry)(registers.as_mut_ptr(), &raw mut context) };
        let [low, high] = context.atoms;
        *host.atoms() |= u128::from(high) << 64 | u128::from(low);
        answer as u16
    }
}

/// Compiles pieces of code for the processor that this runs on. False where that cannot be done; then they are interpreted.
pub fn compile<'c>(codes: impl Iterator<Item = &'c Code> + Clone) -> bool {
    let Some(natives) = compile_all(codes.clone()) else {
        return false;
    };
    for (code, native) in codes.zip(natives) {
        // If another thread was first, its machine code does the same.
        let _ = code.native.set(native);
    }
    true
}

fn compile_all<'c>(codes: impl Iterator<Item = &'c Code>) -> Option<Vec<Native>> {
    let mut flags = settings::builder();
    flags.set("opt_level", "speed").ok()?;
    flags.set("is_pic", "false").ok()?;
    let isa = cranelift::native::builder().ok()?;
    let isa = isa.finish(settings::Flags::new(flags)).ok()?;
    let mut module = JITModule::new(JITBuilder::with_isa(isa, default_libcall_names()));
    let natives = fill(&mut module, codes);
    let pages = Arc::new(Pages(ManuallyDrop::new(module)));
    let natives = natives?.into_iter().map(|entry| Native {
        entry,
        _pages: pages.clone(),
    });
    Some(natives.collect())
}

fn fill<'c>(module: &mut JITModule, codes: impl Iterator<Item = &'c Code>) -> Option<Vec<Entry>> {
    let pointer = module.target_config().pointer_type();
    let mut context = module.make_context();
    let mut memory = FunctionBuilderContext::new();
    let mut ids = Vec::new();
    for code in codes {
        let signature = &mut context.func.signature;
        signature.params = vec![AbiParam::new(pointer); 2];
        signature.returns = vec![AbiParam::new(types::I32)];
        let id = module.declare_anonymous_function(signature).ok()?;
        if !translate(code, &mut context.func, &mut memory, pointer) {
            return None;
        }
        module.define_function(id, &mut context).ok()?;
        module.clear_context(&mut context);
        ids.push(id);
    }
    module.finalize_definitions().ok()?;
    let entries = ids.into_iter().map(|id| {
        let address = module.get_finalized_function(id);
        // SAFETY: `translate` made a function of this type at this address.
        unsafe { std::mem::transmute::<*const u8, Entry>(address) }
    });
    Some(entries.collect())
}

/// What an instruction calls.
#[derive(Clone, Copy)]
pub(super) enum Callee {
    /// A function of `a`.
    Unary(extern "C" fn(f64) -> f64),
    /// A function of `a` and `b`.
    Binary(extern "C" fn(f64, f64) -> f64),
    /// A question about `a` and `b`.
    Asked(extern "C" fn(&mut Context<'_>, f64, f64) -> f64),
    /// A question about number `a` of something.
    Numbered(extern "C" fn(&mut Context<'_>, u32) -> f64),
    /// Number `a` of something has happened.
    Told(extern "C" fn(&mut Context<'_>, u32)),
    /// Number `a` of the echo sources is read into four registers.
    Look(extern "C" fn(&mut Context<'_>, u32, &mut [f64; 4])),
    /// Whether the point (`a`, `b`) is in sight is told in the second of two registers, and how long that holds in the first.
    Sees(extern "C" fn(&mut Context<'_>, u32, f64, f64, &mut [f64; 2])),
}

impl Callee {
    /// Where it is.
    pub(super) fn address(self) -> usize {
        match self {
            Callee::Unary(f) => f as usize,
            Callee::Binary(f) => f as usize,
            Callee::Asked(f) => f as usize,
            Callee::Numbered(f) => f as usize,
            Callee::Told(f) => f as usize,
            Callee::Look(f) => f as usize,
            Callee::Sees(f) => f as usize,
        }
    }
}

macro_rules! callees {
    (
        unary ($a:ident) { $($unary:ident $un:literal $ut:ident => $ug:ident, $uc:literal, $uf:expr;)* }
        binary ($x:ident, $y:ident) { $($binary:ident $bn:literal $bt:ident => $bg:ident, $bc:literal, $bf:expr;)* }
    ) => {
        /// What an instruction calls if it is not translated otherwise.
        pub(super) fn callee(op: Op) -> Option<Callee> {
            Some(match op {
                $(Op::$unary => {
                    extern "C" fn unary(a: f64) -> f64 {
                        Unary::$unary.apply(a)
                    }
                    Callee::Unary(unary)
                })*
                $(Op::$binary => {
                    extern "C" fn binary(a: f64, b: f64) -> f64 {
                        Binary::$binary.apply(a, b)
                    }
                    Callee::Binary(binary)
                })*
                Op::Direction => Callee::Binary(direction),
                Op::Visible => Callee::Asked(visible),
                Op::Uniform => Callee::Asked(uniform),
                Op::Normal => Callee::Asked(normal),
                Op::Chance => Callee::Asked(chance),
                Op::Pick => Callee::Asked(pick),
                Op::Inside => Callee::Numbered(inside),
                Op::Fire => Callee::Told(fire),
                Op::Look | Op::Nearer | Op::Within => Callee::Look(look),
                Op::Sees => Callee::Sees(sight),
                _ => return None,
            })
        }
    };
}
operators!(callees);

extern "C" fn direction(y: f64, x: f64) -> f64 {
    machine::direction(y, x)
}

extern "C" fn visible(context: &mut Context<'_>, x: f64, y: f64) -> f64 {
    machine::truth(context.host.visible(x, y))
}

extern "C" fn sight(context: &mut Context<'_>, first: u32, x: f64, y: f64, parts: &mut [f64; 2]) {
    let (seen, until) = context.host.sight(first as u16, x, y);
    *parts = [until, machine::truth(seen)];
}

extern "C" fn uniform(context: &mut Context<'_>, from: f64, to: f64) -> f64 {
    machine::uniform(context.host, from, to)
}

extern "C" fn normal(context: &mut Context<'_>, mean: f64, deviation: f64) -> f64 {
    machine::normal(context.host, mean, deviation)
}

extern "C" fn chance(context: &mut Context<'_>, probability: f64, _: f64) -> f64 {
    machine::chance(context.host, probability)
}

extern "C" fn pick(context: &mut Context<'_>, count: f64, _: f64) -> f64 {
    machine::pick(context.host, count)
}

extern "C" fn inside(context: &mut Context<'_>, place: u32) -> f64 {
    machine::truth(context.host.inside(place as u16))
}

extern "C" fn fire(context: &mut Context<'_>, event: u32) {
    context.host.fire(event as u16);
}

extern "C" fn look(context: &mut Context<'_>, source: u32, parts: &mut [f64; 4]) {
    context.host.look(source as u16, parts);
}
