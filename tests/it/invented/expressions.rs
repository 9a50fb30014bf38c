//! Expressions of every type.

use super::author::{Author, Known, Region, Type};

impl Author {
    /// An expression of a type, at most so deep.
    pub(super) fn expr(&mut self, ty: &Type, depth: usize, region: Region) -> String {
        if self.chance(25)
            && let Some(known) = self.known(ty, depth, region)
        {
            return known;
        }
        if depth == 0 {
            return self.leaf(ty, region);
        }
        let depth = depth - 1;
        if self.chance(12) {
            return self.choice(ty, depth, region);
        }
        match ty {
            Type::Bool => self.truth(depth, region),
            Type::Point => match self.below(4) {
                0 => self.leaf(ty, region),
                _ => {
                    let x = self.expr(&Type::Length, depth, region);
                    let y = self.expr(&Type::Length, depth, region);
                    format!("({x}, {y})")
                }
            },
            Type::Kind(kind) if self.chance(50) => {
                let name = self.name("t");
                let bound = [(name.clone(), ty.clone())];
                match self.chance(30) {
                    true => format!("nearest({name} in {kind})"),
                    false => {
                        let body = self.with(&bound, |it| it.truth(depth, steady(region)));
                        // Never nowhere for certain: a constant that is infinite is an error.
                        format!("nearest({name} in {kind}: visible({name}) or {body})")
                    }
                }
            }
            Type::Enum(_) | Type::Kind(_) | Type::Door | Type::Robot => self.leaf(ty, region),
            quantity => self.quantity(quantity, depth, region),
        }
    }

    fn choice(&mut self, ty: &Type, depth: usize, region: Region) -> String {
        if matches!(ty, Type::Robot | Type::Door) {
            return self.leaf(ty, region);
        }
        if region.draws && self.chance(40) {
            let a = self.expr(ty, depth, region);
            let b = self.expr(ty, depth, region);
            return format!("one_of({a}, {b})");
        }
        let condition = self.truth(depth, region);
        let a = self.expr(ty, depth, region);
        let b = self.expr(ty, depth, region);
        if self.chance(30) && Type::QUANTITIES.contains(ty) {
            let name = self.name("v");
            let value = self.expr(ty, depth, region);
            let bound = [(name.clone(), ty.clone())];
            let rest = self.with(&bound, |it| it.expr(ty, depth, region));
            return format!(
                "(if {condition} {{ {a} }} else {{ let {name} = {value} {name} + {rest} }})"
            );
        }
        if self.chance(20) {
            let (other, c) = (self.truth(0, region), self.leaf(ty, region));
            return format!("(if {condition} {{ {a} }} else if {other} {{ {c} }} else {{ {b} }})");
        }
        format!("(if {condition} {{ {a} }} else {{ {b} }})")
    }

    /// A constant that may be tuned.
    pub(super) fn tuned(&mut self, ty: &Type) -> Option<&'static str> {
        let of: &[&str] = match ty {
            Type::Number => &["tune(2)", "tune(-1, -3 .. 0)"],
            Type::Ratio => &["tune(25%, 5% .. 60%)"],
            Type::Length => &["tune(1 m)", "tune(35 cm, 200 mm .. 0.5 m)"],
            Type::Time => &["tune(2 s, 500 ms .. 5 s)"],
            Type::Angle => &["tune(30 deg, 10 deg .. 1 rad)"],
            Type::Speed => &["tune(0.2 m/s)"],
            Type::Turn => &["tune(1 rad/s, 20 deg/s .. 2 rad/s)"],
            _ => return None,
        };
        Some(self.pick(of))
    }

    /// Something that has a name and the type.
    fn known(&mut self, ty: &Type, depth: usize, region: Region) -> Option<String> {
        let has = &self.has;
        let lists = [&self.scope, &has.states, &has.shared, &has.predicates];
        // What reads a sensor of the worker, perhaps through another name, is nothing for a script.
        let lists = &lists[..if region.script { 2 } else { 4 }];
        let all = lists.iter().copied().flatten();
        let fit: Vec<Known> = all.filter(|known| known.ty == *ty).cloned().collect();
        if fit.is_empty() {
            return None;
        }
        let known = self.pick(&fit);
        if known.params.is_empty() {
            return Some(known.name);
        }
        let args: Vec<String> = known
            .params
            .iter()
            .map(|ty| self.expr(ty, depth.min(1), steady(region)))
            .collect();
        // A shared expression has one parameter, `p`.
        let is_shared = self.has.shared.iter().any(|it| it.name == known.name);
        let named = if is_shared && self.chance(30) {
            "p = "
        } else {
            ""
        };
        Some(format!("{}({named}{})", known.name, args.join(", ")))
    }

    fn leaf(&mut self, ty: &Type, region: Region) -> String {
        if region.tunes
            && self.chance(10)
            && let Some(tuned) = self.tuned(ty)
        {
            return tuned.to_owned();
        }
        let of: Vec<&str> = match ty {
            Type::Bool => vec!["true", "false", "touching"],
            Type::Number => vec!["0", "1", "2.5", "7", "1e-1", "1_0"],
            Type::Ratio => vec!["0%", "25%", "100%"],
            Type::Length => vec![
                "0 m",
                "35 cm",
                "1.5 m",
                "position.x",
                "position.y",
                "400 mm",
            ],
            Type::Time if region.elapsed => vec!["elapsed", "tick", "2 s"],
            Type::Time => vec!["tick", "3 ticks", "1500 ms", "0.1 min"],
            Type::Angle => vec!["heading", "90 deg", "0.4 rad", "-30 deg"],
            Type::Speed => vec!["max_speed", "0.2 m/s", "-10 cm/s"],
            Type::Turn => vec!["max_turn", "1 rad/s", "-40 deg/s"],
            Type::Point => match region.script || self.has.robots.is_empty() {
                true => vec!["position", "(1 m, 2 m)"],
                false => return format!("pose({})", self.pick(&self.has.robots.clone())),
            },
            Type::Enum(_) | Type::Kind(_) | Type::Door => {
                return self.pick(&self.members(ty));
            }
            Type::Robot => match region.script {
                true => return "worker".to_owned(),
                false => return self.pick(&self.members(ty)),
            },
        };
        self.pick(&of).to_owned()
    }

    /// A target with its name or chosen, of any sort.
    pub(super) fn target(&mut self, depth: usize, region: Region) -> String {
        let kinds: Vec<Type> = self
            .has
            .kinds
            .iter()
            .map(|(kind, _)| Type::Kind(kind))
            .collect();
        match self.below(7) {
            0 => "nearest_wall".to_owned(),
            1 if !self.has.walls.is_empty() => self.pick(&self.has.walls.clone()),
            2 if region.script || !self.has.robots.is_empty() => self.leaf(&Type::Robot, region),
            3 => self.expr(&Type::Point, depth.min(1), region),
            4 if !region.script && !self.has.sensors.is_empty() => {
                self.pick(&self.has.sensors.clone())
            }
            5 => self.pick(&self.has.places.clone()),
            _ => {
                let ty = self.pick(&kinds);
                self.expr(&ty, depth.min(2), region)
            }
        }
    }

    fn truth(&mut self, depth: usize, region: Region) -> String {
        let ty = self.pick(&Type::QUANTITIES);
        match self.below(11) {
            0..=2 => {
                let op = self.pick(&["<", "<=", ">", ">=", "==", "!="]);
                let a = self.expr(&ty, depth, region);
                let b = self.expr(&ty, depth, region);
                format!("({a} {op} {b})")
            }
            3 => {
                let op = self.pick(&["and", "or"]);
                let a = self.expr(&Type::Bool, depth, region);
                let b = self.expr(&Type::Bool, depth, region);
                format!("({a} {op} {b})")
            }
            4 => {
                let a = self.expr(&Type::Bool, depth, region);
                format!("(not {a})")
            }
            5 => format!("visible({})", self.target(depth, region)),
            6 => {
                let place = self.pick(&self.has.places.clone());
                match self.by_another().filter(|_| !region.script) {
                    Some((_, robot)) => format!("inside({place}, by = {robot})"),
                    None => format!("inside({place})"),
                }
            }
            7 => {
                let kind = Type::Kind(self.has.kinds[0].0);
                let a = self.expr(&kind, depth, region);
                format!("inside({a})")
            }
            8 => {
                let ty = self.ranging();
                let (a, b) = (self.expr(&ty, depth, region), self.leaf(&ty, region));
                format!("({a} {} {b})", self.pick(&["==", "!="]))
            }
            9 if self.chance(30) => {
                let kind = self.has.kinds[1].0;
                let name = self.name("t");
                format!("(nearest({name} in {kind}: visible({name})) != nowhere)")
            }
            9 => {
                let all = self.pick(&["any", "all"]);
                self.binder(all, depth, region)
            }
            _ if region.draws => "chance(40%)".to_owned(),
            _ => self.leaf(&Type::Bool, region),
        }
    }

    fn binder(&mut self, word: &str, depth: usize, region: Region) -> String {
        let ty = match region.script {
            true => Type::Kind(self.has.kinds[0].0),
            false => self.ranging(),
        };
        let name = self.name("e");
        let bound = [(name.clone(), ty.clone())];
        let body = self.with(&bound, |it| it.truth(depth.min(1), steady(region)));
        format!("{word}({name} in {}: {body})", ty.written())
    }

    fn quantity(&mut self, ty: &Type, depth: usize, region: Region) -> String {
        let a = self.expr(ty, depth, region);
        let b = self.expr(ty, depth, region);
        match self.below(14) {
            0 => format!("({a} + {b})"),
            1 => format!("({a} - {b})"),
            2 => format!("{}({a}, {b})", self.pick(&["min", "max"])),
            3 if self.chance(30) => format!("clamp({a}, {b}, {b} + abs({a}))"),
            3 => format!("clamp({a}, abs({b}))"),
            4 => format!("abs({a})"),
            5 => format!("({}{a})", self.pick(&["-", "+"])),
            6 if *ty != Type::Ratio => {
                let n = self.expr(&Type::Number, depth, region);
                format!("({n} * {a})")
            }
            7 if *ty != Type::Ratio => {
                let n = self.expr(&Type::Number, depth, region);
                format!("({a} / (abs({n}) + 1))")
            }
            8 if region.draws => {
                format!("uniform({a}, {a} + abs({b}))")
            }
            9 if region.draws => format!("normal({a}, abs({b}))"),
            _ => self.reading(ty, depth, region),
        }
    }

    /// A way to get a quantity from something else.
    fn reading(&mut self, ty: &Type, depth: usize, region: Region) -> String {
        let n = self.expr(&Type::Number, depth, region);
        match ty {
            Type::Number => match self.below(6) {
                0 => self.binder("count", depth, region),
                1 => {
                    let f = self.pick(&["sin", "cos", "tan"]);
                    let a = self.expr(&Type::Angle, depth, region);
                    format!("{f}({a})")
                }
                2 => format!("{}({n})", self.pick(&["floor", "ceil", "round", "sign"])),
                3 => self
                    .pick(&[
                        "exp(clamp(X, 3))",
                        "ln(abs(X) + 1)",
                        "sqrt(abs(X))",
                        "(X)^2",
                        "-(X)^2",
                    ])
                    .replace('X', &n),
                4 => {
                    let ty = self.pick(&Type::QUANTITIES[2..]);
                    let (a, b) = (self.expr(&ty, depth, region), self.leaf(&ty, region));
                    let one = match ty {
                        Type::Length => "1 m",
                        Type::Time => "1 s",
                        Type::Angle => "1 rad",
                        Type::Speed => "1 m/s",
                        _ => "1 rad/s",
                    };
                    format!("({a} / (abs({b}) + {one}))")
                }
                _ => self.expr(&Type::Ratio, depth, region),
            },
            Type::Length => match self.below(4) {
                0 | 1 => format!("distance({})", self.target(depth, region)),
                2 => {
                    let place = self.pick(&self.has.places.clone());
                    let point = self.expr(&Type::Point, depth.min(1), region);
                    format!("distance({place}, {point})")
                }
                _ => {
                    let a = self.expr(&Type::Length, depth, region);
                    let b = self.expr(&Type::Length, depth, region);
                    format!("sqrt(({a})^2 + ({b})^2)")
                }
            },
            Type::Angle => match self.below(6) {
                0 => format!("bearing({})", self.target(depth, region)),
                1 => format!("direction({})", self.target(depth, region)),
                2 => {
                    let a = self.expr(&Type::Angle, depth, region);
                    format!("wrap({a})")
                }
                3 => {
                    let a = self.expr(&Type::Length, depth, region);
                    let b = self.expr(&Type::Length, depth, region);
                    format!("atan2({a}, {b})")
                }
                4 => self
                    .pick(&["asin(clamp(X, 1))", "acos(clamp(X, 1))", "atan(X)"])
                    .replace('X', &n),
                _ if self.has.facing.is_empty() => self.leaf(ty, region),
                _ => format!("facing({})", self.pick(&self.has.facing.clone())),
            },
            Type::Speed => format!("(0.5 Hz * distance({}))", self.target(depth, region)),
            Type::Turn => format!("(beat * bearing({}))", self.target(depth, region)),
            Type::Time => format!("(distance({}) / max_speed)", self.target(depth, region)),
            _ => self.leaf(ty, region),
        }
    }
}

/// The same region, without draws: what is looked at once for each member.
fn steady(region: Region) -> Region {
    Region {
        draws: false,
        ..region
    }
}
