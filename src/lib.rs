//! `btc` compiles behaviour trees that robots learn by themselves: a `.bt` file is checked, simulated, learned
//! from, and the learned policy is printed as the tree that a person would have written, proved equal to it.
//!
//! # From a program to a tree
//!
//! [`Program`] reads and checks a `.bt` file. Learning gives a [`Tree`] that is proved equal to the learned policy:
//!
//! ```
//! use btc::{LearnOptions, Program, TreeForm};
//!
//! # fn main() -> Result<(), btc::Error> {
//! let program = Program::from_file("examples/delivery_small.bt")?;
//! let options = LearnOptions {
//!     episodes: Some(400),
//!     roll_outs: 100,
//!     effort: 1_000_000,
//!     ..LearnOptions::default()
//! };
//! let learned = program.learn(&options)?;
//! println!("{}", learned.tree());
//! assert_eq!(learned.tree().size().nodes, 10);
//!
//! // For a robot, and for other tools.
//! let xml = learned.tree().emit(TreeForm::BtCpp)?;
//! assert!(xml.contains("BTCPP_format=\"4\""));
//! assert!(learned.file("policy.csv").is_some());
//! # Ok(())
//! # }
//! ```
//!
//! # Any policy table as a tree
//!
//! ```
//! use btc::{DecanonicaliseOptions, PolicyTable, Program};
//!
//! # fn main() -> Result<(), btc::Error> {
//! let table = PolicyTable::from_text(
//!     "dock.csv",
//!     "low,at_dock,behavior\n1,0,find_dock\n1,1,charge\n0,-,patrol\n",
//! );
//! let tree = table.decanonicalise(&DecanonicaliseOptions::default())?;
//! assert_eq!(
//!     tree.to_string().lines().skip(1).collect::<Vec<_>>().join("\n"),
//!     "tree learned = selector {
//!     not low => patrol,
//!     at_dock => charge,
//!     find_dock,
//! }"
//! );
//!
//! // A tree by hand, held against the table.
//! let program = Program::from_text(
//!     "predicate low
//!      predicate at_dock
//!      behavior find_dock
//!      behavior charge
//!      behavior patrol
//!      tree hand = selector { low and at_dock => charge, low => find_dock, patrol }",
//! )?;
//! assert!(program.prove_decisions("hand", &table)?.holds());
//! # Ok(())
//! # }
//! ```
//!
//! # Proofs
//!
//! ```
//! # fn main() -> Result<(), btc::Error> {
//! let program = btc::Program::from_file("examples/delivery_large.bt")?;
//! let proved = program.prove_equal("expert", "table_1")?;
//! assert!(!proved.holds());
//! println!("{}", proved.text); // a shortest trace on which they part
//! # Ok(())
//! # }
//! ```
//!
//! # A tree in a loop of your own
//!
//! A [`Ticker`] asks your [`Robot`] for predicates and has it run behaviours:
//!
//! ```
//! use btc::{Program, Robot, Status};
//!
//! struct Simulated {
//!     battery: u32,
//!     log: Vec<String>,
//! }
//!
//! impl Robot for Simulated {
//!     fn holds(&mut self, predicate: &str) -> bool {
//!         predicate == "battery_low" && self.battery < 25
//!     }
//!     fn tick(&mut self, behavior: &str) -> Status {
//!         self.log.push(behavior.to_owned());
//!         if behavior == "dock(C)" {
//!             self.battery = 100;
//!         }
//!         Status::Success
//!     }
//! }
//!
//! # fn main() -> Result<(), btc::Error> {
//! let program = Program::from_file("examples/delivery_small.bt")?;
//! let mut ticker = program.tree("expert")?.ticker();
//! let mut robot = Simulated { battery: 20, log: Vec::new() };
//! for _ in 0..3 {
//!     ticker.tick(&mut robot);
//! }
//! assert_eq!(robot.log, ["goto(C)", "dock(C)", "goto(A)"]);
//! # Ok(())
//! # }
//! ```
//!
//! # A world of your own
//!
//! An [`Environment`] is simulated by your program; a [`Trainer`] gives its predicates and behaviours their names and
//! learns a tree for it:
//!
//! ```
//! use btc::{Ended, Environment, LearnOptions, Outcome, Status, Trainer};
//!
//! #[derive(Default)]
//! struct Corridor {
//!     cell: i64,
//!     step: i64,
//! }
//!
//! impl Environment for Corridor {
//!     fn start(&mut self, seed: u64) {
//!         self.cell = (seed % 9) as i64 - 4;
//!     }
//!     fn holds(&self, _predicate: usize) -> bool {
//!         self.cell < 0
//!     }
//!     fn act(&mut self, behavior: usize) -> Status {
//!         self.step = [-1, 1][behavior];
//!         Status::Running
//!     }
//!     fn step(&mut self) -> Outcome {
//!         self.cell += self.step;
//!         if self.cell == 0 { Outcome::end(10.0, Ended::Good) } else { Outcome::on(-1.0) }
//!     }
//! }
//!
//! # fn main() -> Result<(), btc::Error> {
//! let trainer = Trainer::new(Corridor::default)
//!     .predicates(["left_of_door"])
//!     .behaviors(["go_left", "go_right"])
//!     .limit(20)
//!     .episodes(200);
//! let options = LearnOptions { effort: 20_000, roll_outs: 50, ..LearnOptions::default() };
//! let trained = trainer.learn(&options)?;
//! assert!(trained.tree().to_string().contains("left_of_door => go_right"));
//! # Ok(())
//! # }
//! ```
//!
//! # The rooms of the crate
//!
//! All of the above stands on the modules below. They are internals: public, so that tests, benches and the command
//! line share them, but they change with any version. They stand in the order in which a program goes through them;
//! `ARCHITECTURE.md` shows the way.

mod facade;

pub use facade::*;

pub mod source;

pub mod diagnostic;

pub mod spelling;

pub mod syntax;

pub mod check;

pub mod ir;

pub mod math;

pub mod random;

pub mod geometry;

pub mod eval;

pub mod world;

pub mod checkpoint;

pub mod learn;

pub mod environment;

pub mod policy;

pub mod logic;

pub mod tree;

pub mod trial;

pub mod grow;

pub mod tune;

pub mod emit;

pub mod report;

pub mod driver;

#[cfg(feature = "cli")]
pub mod lsp;

#[cfg(feature = "cli")]
pub mod cli;
