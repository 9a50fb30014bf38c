//! States, events, effects, predicates, behaviours, tasks, learners and claims.

use super::author::{Author, Choice, Known, Region, Type};
use std::fmt::Write as _;

/// How deep expressions are.
const DEPTH: usize = 3;

/// An event: what happens in a tick may be asked, and nothing is drawn.
const EVENT: Region = Region {
    draws: false,
    elapsed: false,
    script: false,
    tunes: false,
};
/// What is looked at before every decision.
const LOOKED_AT: Region = Region {
    tunes: true,
    ..EVENT
};
const EFFECT: Region = Region {
    draws: true,
    ..EVENT
};
const LAW: Region = Region {
    elapsed: true,
    ..LOOKED_AT
};
const CONTROL: Region = Region { draws: true, ..LAW };
/// Where a behaviour starts: its own variables are not known yet, nor how long it has run.
const CONTROL_START: Region = Region {
    draws: true,
    ..LOOKED_AT
};
const SCRIPT: Region = Region {
    script: true,
    ..EVENT
};

impl Author {
    /// A program, and its trees by name.
    pub(super) fn program(&mut self) -> (String, Vec<String>) {
        let mut out = String::from("use std\n\n");
        self.has.enums = vec![
            ("gear", vec!["off", "slow", "fast"]),
            ("cargo", vec!["nothing", "parcel"]),
        ];
        out.push_str("let beat: frequency = 2 Hz\n\nenum gear { off, slow, fast }\nenum cargo { nothing, parcel }\n\n");
        self.world(&mut out);
        self.states(&mut out);
        self.shared(&mut out);
        self.predicates(&mut out);
        self.behaviors(&mut out);
        self.events(&mut out);
        self.effects(&mut out);
        self.scripts(&mut out);
        let observed = self.task(&mut out);
        let trees = self.trees(&mut out, &observed);
        self.learner(&mut out, "learned", "work");
        self.errands(&mut out);
        self.claims(&mut out, &trees);
        (out, trees)
    }

    fn anything(&mut self) -> Type {
        let mut types = Type::QUANTITIES.to_vec();
        types.extend([
            Type::Bool,
            Type::Point,
            Type::Enum("gear"),
            Type::Kind("trees"),
            Type::Kind("shops"),
        ]);
        self.pick(&types)
    }

    fn states(&mut self, out: &mut String) {
        if !self.has.doors.is_empty() {
            out.push_str("state shut(d: door): bool = true\n");
            let shut = Known {
                name: "shut".to_owned(),
                params: vec![Type::Door],
                ty: Type::Bool,
            };
            self.has.states.push(shut);
        }
        for _ in 0..self.count(2, 6) {
            let (name, ty) = (self.name("s"), self.anything());
            let value = self.constant(&ty);
            let _ = match self.chance(80) || matches!(ty, Type::Kind(_)) {
                true => writeln!(
                    out,
                    "/// What {name} is.\nstate {name}: {} = {value}",
                    ty.written()
                ),
                false => writeln!(out, "state {name} = {value} // as it says"),
            };
            self.has.states.push(Known {
                name,
                params: Vec::new(),
                ty,
            });
        }
        for _ in 0..self.count(1, 3) {
            let (name, ty, of) = (self.name("f"), self.anything(), self.ranging());
            let value = self.constant(&ty);
            let _ = writeln!(
                out,
                "state {name}(m: {}): {} = {value}",
                of.written(),
                ty.written()
            );
            self.has.states.push(Known {
                name,
                params: vec![of],
                ty,
            });
        }
        out.push('\n');
    }

    fn shared(&mut self, out: &mut String) {
        for _ in 0..self.below(3) {
            let (name, ty) = (self.name("l"), self.anything());
            let params = [
                Type::Number,
                Type::Length,
                Type::Angle,
                Type::Bool,
                Type::Speed,
            ];
            let param = self.pick(&params);
            let written = match param {
                Type::Speed => self.pick(&["speed", "length / time"]),
                _ => param.written(),
            };
            let default = match self.chance(30) {
                true => format!(" = {}", self.constant(&param)),
                false => String::new(),
            };
            let bound = [("p".to_owned(), param.clone())];
            let value = self.with(&bound, |it| it.expr(&ty, DEPTH, EVENT));
            let _ = match self.chance(50) {
                true => writeln!(out, "let {name}(p: {written}{default}) = {value}"),
                false => writeln!(
                    out,
                    "let {name}(p: {written}{default}): {} = {{\n let q = p\n {value}\n}}",
                    ty.written()
                ),
            };
            self.has.shared.push(Known {
                name,
                params: vec![param],
                ty,
            });
        }
        out.push('\n');
    }

    fn predicates(&mut self, out: &mut String) {
        let mut made = Vec::new();
        for _ in 0..self.count(2, 4) {
            let name = self.name("p");
            let body = self.expr(&Type::Bool, DEPTH, LOOKED_AT);
            let _ = writeln!(out, "predicate {name} = {body}");
            made.push(Known {
                name,
                params: Vec::new(),
                ty: Type::Bool,
            });
        }
        for _ in 0..self.count(1, 2) {
            let (name, of) = (self.name("p"), self.ranging());
            let bound = [("m".to_owned(), of.clone())];
            let body = self.with(&bound, |it| it.expr(&Type::Bool, DEPTH, LOOKED_AT));
            let _ = writeln!(out, "predicate {name}(m: {}) = {body}", of.written());
            made.push(Known {
                name,
                params: vec![of],
                ty: Type::Bool,
            });
        }
        self.has.predicates = made;
        out.push('\n');
    }

    fn behaviors(&mut self, out: &mut String) {
        let tree = self.pick(&self.members(&Type::Kind("trees")));
        let shop = self.pick(&self.members(&Type::Kind("shops")));
        let near = self.expr(&Type::Kind("trees"), 2, EVENT);
        let (yes, no) = (true, false);
        let mut library = vec![
            (format!("goto({tree})"), yes, yes),
            ("goto(post, margin = 10 cm)".to_owned(), yes, yes),
            (format!("approach({shop})"), yes, yes),
            ("approach((1 m, 3 m), within = 20 cm)".to_owned(), yes, yes),
            (format!("follow({near}, gap = 50 cm)"), no, no),
            (format!("chase({near})"), no, no),
            ("flee(nearest_wall, safe = 50 cm)".to_owned(), yes, no),
            (format!("patrol({tree}, post)"), no, yes),
            (format!("turn_to({shop}, slack = 10 deg)"), yes, no),
            ("follow_wall".to_owned(), no, no),
            (
                "follow_wall(gap = 40 cm, catch = 60 cm, lose = 1 m)".to_owned(),
                no,
                no,
            ),
            ("wander(leg = 60 cm)".to_owned(), yes, no),
            ("idle".to_owned(), no, no),
            ("wait(500 ms)".to_owned(), yes, no),
            ("wait(duration = 800 ms)".to_owned(), yes, no),
        ];
        let robot = self.has.robots.first();
        library.extend(robot.map(|robot| (format!("chase({robot})"), no, no)));
        let facing = self.has.facing.first();
        library.extend(facing.map(|place| {
            let call = format!("dock(station = {place}, reach = 30 cm, slack = 5 deg)");
            (call, yes, yes)
        }));
        let mut library: Vec<Choice> = library
            .into_iter()
            .map(|(call, succeeds, fails)| Choice {
                call,
                family: None,
                succeeds,
                fails,
            })
            .collect();
        if self.chance(20) {
            out.push_str("behavior idle { succeed when elapsed > 1 s }\n\n");
            for idle in library.iter_mut().filter(|it| it.call == "idle") {
                idle.succeeds = true;
            }
        }
        for _ in 0..self.count(1, 3) {
            let choice = self.behavior(out);
            library.push(choice.clone());
            self.has.choices.push(choice);
        }
        for _ in 0..self.count(1, 3) {
            let choice = self.pick(&library);
            if !self.has.choices.contains(&choice) {
                self.has.choices.push(choice);
            }
        }
        if self.chance(30) {
            let family = self.pick(&[
                "goto(t in KIND, margin = 15 cm)",
                "chase(t in KIND, margin = 15 cm)",
            ]);
            let ends = family.starts_with("goto");
            let kind = self.pick(&["trees", "shops"]);
            for member in self.members(&Type::Kind(kind)) {
                self.has.choices.push(Choice {
                    call: family.replace("t in KIND", &member),
                    family: Some(family.replace("KIND", kind)),
                    succeeds: ends,
                    fails: ends,
                });
            }
        }
        let (alias, of) = (self.name("alias"), self.pick(&library));
        let _ = writeln!(out, "behavior {alias} = {}\n", of.call);
        self.has.choices.push(Choice { call: alias, ..of });
    }

    /// A behaviour with a law of its own; what it is called with.
    fn behavior(&mut self, out: &mut String) -> Choice {
        let name = self.name("b");
        let ty = self.pick(&[
            Type::Kind("trees"),
            Type::Length,
            Type::Angle,
            Type::Number,
            Type::Bool,
            Type::Point,
        ]);
        let default = self.constant(&ty);
        let _ = writeln!(
            out,
            "behavior {name}(at: {} = {default}, target: target = post) {{",
            ty.written()
        );
        let mut bound = vec![("at".to_owned(), ty.clone())];
        let mut locals = Vec::new();
        for _ in 0..self.below(3) {
            let (local, ty) = (self.name("v"), self.anything());
            let value = self.with(&bound, |it| it.expr(&ty, 2, CONTROL_START));
            let _ = match self.chance(80) || matches!(ty, Type::Kind(_)) {
                true => writeln!(out, "local {local}: {} = {value}", ty.written()),
                false => writeln!(out, "local {local} = {value}"),
            };
            bound.push((local.clone(), ty.clone()));
            locals.push(Known {
                name: local,
                params: Vec::new(),
                ty,
            });
        }
        let (succeeds, fails) = (self.chance(60), self.chance(40));
        let text = self.with(&bound, |it| {
            let mut text = String::new();
            if it.chance(30) {
                let state = it.expr(&Type::Bool, 2, LAW);
                let _ = writeln!(text, "requires {state} or elapsed < 1 s");
            }
            for (clause, ends, time) in [("succeed", succeeds, 2), ("fail", fails, 3)] {
                if ends {
                    let state = it.expr(&Type::Bool, 2, LAW);
                    let _ = writeln!(text, "{clause} when {state} or elapsed > {time} s");
                }
            }
            if it.chance(85) {
                text.push_str("control {\n");
                for _ in 0..it.below(3) {
                    it.statement(&mut text, &locals, 2, CONTROL);
                }
                it.drive(&mut text, 2);
                text.push_str("}\n");
            }
            text
        });
        let _ = writeln!(out, "{text}}}\n");
        let call = match self.below(3) {
            0 => name,
            1 => format!("{name}({})", self.constant(&ty)),
            _ => {
                let target = self.pick(&self.has.places.clone());
                format!("{name}(target = {target})")
            }
        };
        Choice {
            call,
            family: None,
            succeeds,
            fails,
        }
    }

    fn drive(&mut self, text: &mut String, depth: usize) {
        if depth > 0 && self.chance(30) {
            let condition = self.expr(&Type::Bool, 2, CONTROL);
            let _ = writeln!(text, "if {condition} {{");
            self.drive(text, depth - 1);
            text.push_str("} else {\n");
            self.drive(text, depth - 1);
            text.push_str("}\n");
            return;
        }
        let speed = self.expr(&Type::Speed, 2, CONTROL);
        let turn = self.expr(&Type::Turn, 2, CONTROL);
        let _ = match self.below(5) {
            0 => Ok(()),
            1 => writeln!(text, "drive(course = direction(target))"),
            2 => {
                let course = self.expr(&Type::Angle, 2, CONTROL);
                writeln!(text, "drive(course = {course}, speed = {speed})")
            }
            3 if self.has.holonomic => {
                let strafe = self.expr(&Type::Speed, 2, CONTROL);
                writeln!(
                    text,
                    "drive(speed = {speed}, strafe = {strafe}, turn = {turn})"
                )
            }
            _ => writeln!(text, "drive(speed = {speed}, turn = {turn})"),
        };
    }

    /// A statement that sets some of these variables.
    fn statement(&mut self, text: &mut String, variables: &[Known], depth: usize, region: Region) {
        match self.below(if depth > 0 { 8 } else { 4 }) {
            0..=3 if variables.is_empty() => {}
            0..=3 => {
                let variable = self.pick(variables);
                let args: Vec<String> = variable
                    .params
                    .iter()
                    .map(|ty| self.expr(ty, 1, region))
                    .collect();
                let target = match args.is_empty() {
                    true => variable.name,
                    false => format!("{}({})", variable.name, args.join(", ")),
                };
                let quantity = Type::QUANTITIES.contains(&variable.ty);
                let (op, ty) = match quantity && self.chance(50) {
                    true => self.pick(&[
                        ("+=", variable.ty.clone()),
                        ("-=", variable.ty),
                        ("*=", Type::Number),
                    ]),
                    false => ("=", variable.ty),
                };
                let value = self.expr(&ty, 2, region);
                let _ = writeln!(text, "{target} {op} {value}");
            }
            4 => {
                let (name, ty) = (self.name("v"), self.anything());
                let value = self.expr(&ty, 2, region);
                let _ = writeln!(text, "let {name} = {value}");
                let bound = [(name, ty)];
                self.with(&bound, |it| {
                    it.statement(text, variables, depth - 1, region)
                });
            }
            5 | 6 => {
                let condition = self.expr(&Type::Bool, 2, region);
                let _ = writeln!(text, "if {condition} {{");
                self.statement(text, variables, depth - 1, region);
                if self.chance(30) {
                    let other = self.expr(&Type::Bool, 1, region);
                    let _ = writeln!(text, "}} else if {other} {{");
                    self.statement(text, variables, depth - 1, region);
                }
                if self.chance(70) {
                    text.push_str("} else {\n");
                    self.statement(text, variables, depth - 1, region);
                }
                text.push_str("}\n");
            }
            _ => {
                let (name, ty) = (self.name("e"), self.ranging());
                let _ = writeln!(text, "for {name} in {} {{", ty.written());
                let bound = [(name, ty)];
                self.with(&bound, |it| {
                    it.statement(text, variables, depth - 1, region)
                });
                text.push_str("}\n");
            }
        }
    }

    fn events(&mut self, out: &mut String) {
        for _ in 0..self.count(2, 4) {
            let name = self.name("on");
            let family = self.chance(30).then(|| self.ranging());
            let bound: Vec<_> = family
                .iter()
                .map(|ty| ("m".to_owned(), ty.clone()))
                .collect();
            let state = self.with(&bound, |it| it.expr(&Type::Bool, DEPTH, EVENT));
            let behavior = self.pick(&self.has.choices.clone());
            let moments = [
                ("success", behavior.succeeds),
                ("failure", behavior.fails),
                ("running", true),
            ];
            let moments: Vec<_> = moments.iter().filter(|(_, may)| *may).collect();
            let ((moment, _), behavior) = (self.pick(&moments), behavior.call);
            let other = self.by_another();
            let body = match (self.below(4), other) {
                (0, _) => state,
                (1, Some((does, robot))) => {
                    let moment = self.pick(&["success", "failure", "running"]);
                    let moment = match does.as_str() {
                        "goto(post)" => moment,
                        _ => self.pick(&["success", "running"]),
                    };
                    format!("{moment}({does}, by = {robot})")
                }
                (1 | 2, _) => format!("{moment}({behavior})"),
                _ => format!("{moment}({behavior}) and {state}"),
            };
            let _ = match &family {
                None => writeln!(out, "event {name} = {body}"),
                Some(ty) => writeln!(out, "event {name}(m: {}) = {body}", ty.written()),
            };
            self.has.events.push(Known {
                name,
                params: family.into_iter().collect(),
                ty: Type::Bool,
            });
        }
        out.push('\n');
    }

    fn effects(&mut self, out: &mut String) {
        let states = self.has.states.clone();
        out.push_str("each tick {\n");
        for _ in 0..self.count(1, 3) {
            self.statement(out, &states, 2, EFFECT);
        }
        out.push_str("}\n");
        for event in self.has.events.clone() {
            let bound: Vec<_> = event
                .params
                .iter()
                .map(|ty| ("m".to_owned(), ty.clone()))
                .collect();
            let _ = match event.params.first() {
                None => writeln!(out, "on {} {{", event.name),
                Some(ty) => writeln!(out, "on {}(m: {}) {{", event.name, ty.written()),
            };
            self.with(&bound, |it| it.statement(out, &states, 2, EFFECT));
            out.push_str("}\n");
        }
        if self.chance(40) {
            let condition = self.happening();
            let _ = writeln!(out, "on {condition} {{");
            self.statement(out, &states, 2, EFFECT);
            out.push_str("}\n");
        }
        out.push('\n');
    }

    /// What happens in a tick and has no name.
    fn happening(&mut self) -> String {
        let condition = self.expr(&Type::Bool, 2, EVENT);
        let ends = |choice: &&Choice| choice.succeeds;
        match self.has.choices.iter().find(ends) {
            Some(choice) if self.random.chance(0.5) => {
                format!("success({}) and {condition}", choice.call)
            }
            _ => condition,
        }
    }

    /// What other robots do.
    fn scripts(&mut self, out: &mut String) {
        let close = self.expr(&Type::Bool, 2, SCRIPT);
        let tree = self.pick(&self.members(&Type::Kind("trees")));
        let _ = writeln!(out, "predicate alert = distance(worker) < 1 m or {close}");
        let _ = writeln!(
            out,
            "tree roam = memory sequence {{ wander, wait(300 ms), goto({tree}) }}"
        );
        let _ = writeln!(
            out,
            "tree stalk = selector {{ alert => timeout(2 s) {{ chase(worker) }}, wander }}"
        );
        let _ = writeln!(
            out,
            "tree attend(to: place) = selector {{ alert => flee(worker), goto(to), idle }}\n"
        );
    }

    /// The task; the guards that its trees may ask.
    fn task(&mut self, out: &mut String) -> Vec<String> {
        let mut atoms = Vec::new();
        out.push_str("task work {\n");
        let mut observe = Vec::new();
        for predicate in self.has.predicates.clone() {
            match predicate.params.first() {
                None => {
                    observe.push(predicate.name.clone());
                    atoms.push(predicate.name);
                }
                Some(ty) => {
                    observe.push(format!("{}(m in {})", predicate.name, ty.written()));
                    let members = self.members(ty);
                    atoms.extend(
                        members
                            .iter()
                            .map(|member| format!("{}({member})", predicate.name)),
                    );
                }
            }
        }
        let _ = writeln!(out, "observe {}", observe.join(", "));
        let mut choose: Vec<String> = Vec::new();
        for choice in &self.has.choices {
            let written = choice.family.as_ref().unwrap_or(&choice.call);
            if !choose.contains(written) {
                choose.push(written.clone());
            }
        }
        let _ = writeln!(out, "choose {}", choose.join(", "));
        let history = self.chance(70);
        if history {
            let window = self.count(1, 3);
            let _ = writeln!(out, "history last {window} success, failure");
            for behavior in self.has.choices.clone() {
                let Choice {
                    call,
                    succeeds,
                    fails,
                    ..
                } = behavior;
                atoms.extend(succeeds.then(|| format!("done({call})")));
                atoms.extend(fails.then(|| format!("failed({call})")));
            }
        }
        if self.chance(50) {
            out.push_str("patience 5 s\n");
        }
        self.start(out, history);
        let mut events: Vec<String> = Vec::new();
        for event in &self.has.events {
            events.push(match event.params.first() {
                None => event.name.clone(),
                Some(ty) => format!("{}(m in {})", event.name, ty.written()),
            });
        }
        if self.chance(40) {
            let _ = writeln!(out, "end on {}", events[0]);
        }
        if self.chance(20) {
            let condition = self.happening();
            let _ = writeln!(out, "end on {condition}");
        }
        out.push_str("end after 1_000 ticks\nreward {\n");
        for event in self.some(&events) {
            let value = self.expr(&Type::Number, 2, EVENT);
            let _ = writeln!(out, "on {event}: {value}");
        }
        if self.chance(30) {
            let condition = self.happening();
            let _ = writeln!(out, "on {condition}: 0.5");
        }
        if self.chance(50) {
            out.push_str("per 1 s: -0.05\n");
        }
        if self.chance(50) {
            let condition = self.expr(&Type::Bool, 2, EVENT);
            let _ = writeln!(out, "while {condition}, per 1 min: -1");
        }
        if self.chance(50) {
            out.push_str("otherwise: -0.1\n");
        }
        out.push_str("}\n}\n\n");
        atoms
    }

    fn start(&mut self, out: &mut String, history: bool) {
        if self.chance(15) {
            return;
        }
        out.push_str("start {\n");
        match self.below(6) {
            0 => out.push_str("pose = anywhere\n"),
            1 => out.push_str("position = (uniform(0 m, 6 m), uniform(0 m, 4 m))\nheading = uniform(-180 deg, 180 deg)\n"),
            2 => out.push_str("pose = one_of(post, nearest(t in trees))\n"),
            3 => out.push_str("pose = anywhere(post)\n"),
            4 => out.push_str("pose = if chance(50%) { post } else { post }\n"),
            _ => {}
        }
        if let Some(robot) = self.has.robots.first()
            && self.random.chance(0.5)
        {
            let robot = robot.clone();
            let pose = self.pick(&[
                "pose(R) = anywhere",
                "position(R) = (uniform(0 m, 6 m), 2 m)",
                "heading(R) = 90 deg\nposition(R) = (2 m, uniform(1 m, 3 m))",
            ]);
            let _ = writeln!(out, "{}", pose.replace('R', &robot));
        }
        let ended = self.has.choices.iter().find(|choice| choice.succeeds);
        if let Some(ended) = ended.filter(|_| history) {
            let ended = ended.call.clone();
            let _ = match self.below(4) {
                0 => writeln!(out, "history = success({ended})"),
                1 => writeln!(
                    out,
                    "history = if chance(30%) {{ success({ended}) }} else {{ none }}"
                ),
                2 => writeln!(out, "history = none"),
                _ => Ok(()),
            };
        }
        for state in self.has.states.clone() {
            if self.chance(50) {
                continue;
            }
            let value = self.expr(&state.ty, 2, EFFECT);
            let _ = match state.params.first() {
                None => writeln!(out, "{} = {value}", state.name),
                Some(ty) if self.chance(50) => {
                    writeln!(out, "{}(m in {}) = {value}", state.name, ty.written())
                }
                Some(ty) => {
                    let which = self.expr(ty, 2, EFFECT);
                    writeln!(out, "{}({which}) = {value}", state.name)
                }
            };
        }
        out.push_str("}\n");
    }

    fn learner(&mut self, out: &mut String, name: &str, task: &str) {
        let method = self.pick(&["q_learning", "double_q", "model"]);
        let _ = writeln!(
            out,
            "learn {name} for {task} {{\nmethod = {method}\nepisodes = 20 of 200 ticks"
        );
        if method != "model" {
            let rate = self.pick(&[
                "max(visits^-0.7, 0.02)",
                "0.2 -> 0.02",
                "0.5 - 0.4 * progress",
            ]);
            let _ = writeln!(out, "rate = {rate}");
        }
        match self.below(if method == "model" { 3 } else { 2 }) {
            0 => out.push_str("discount = 0.9 per 10 s\n"),
            1 => out.push_str("discount = 0.95 per decision\n"),
            _ => out.push_str("objective = average per 10 s\n"),
        }
        let unseen = self.pick(&self.calls());
        let _ = writeln!(
            out,
            "unseen = {unseen}\ndwell = 300 ms\nseed = {}",
            self.below(100)
        );
        if self.chance(50) {
            let explore = self.pick(&["50% -> 2%", "min(1, visits^-0.5)"]);
            let _ = writeln!(out, "explore = {explore}\ninitial = 0.5");
        }
        if self.chance(30) {
            out.push_str("start {\npose = anywhere\n}\n");
        }
        out.push_str("}\n\n");
    }

    /// A second task, with a tree and a learner.
    fn errands(&mut self, out: &mut String) {
        if self.chance(60) {
            return;
        }
        let plain = |predicate: &&Known| predicate.params.is_empty();
        let predicate = self.has.predicates.iter().find(plain).unwrap();
        let guard = predicate.name.clone();
        let first = self.has.choices[0].clone();
        self.has.choices = vec![first.clone()];
        let choose = first.family.unwrap_or(first.call.clone());
        let _ = writeln!(
            out,
            "task errands {{\nobserve {guard}\nchoose {choose}\nend after 100 ticks\nreward {{ per 1 s: -0.1 }}\n}}\n"
        );
        let _ = writeln!(
            out,
            "tree errand_boy for errands = selector {{ {guard} => {0}, {0} }}\n",
            first.call
        );
        self.learner(out, "errands_learned", "errands");
    }

    fn claims(&mut self, out: &mut String, trees: &[String]) {
        let plain = |event: &&Known| event.params.is_empty();
        let Some(event) = self
            .has
            .events
            .iter()
            .find(plain)
            .map(|event| event.name.clone())
        else {
            return;
        };
        let tree = self.pick(trees);
        let _ = writeln!(out, "claim {tree} never {event} with probability >= 50%");
        let _ = writeln!(
            out,
            "claim {tree} reaches {event} within 1 min with probability >= 10%"
        );
        let _ = writeln!(out, "claim {} equals {}", trees[0], trees[trees.len() - 1]);
        let _ = writeln!(out, "claim {tree} never {event} within 500 ticks");
    }
}
