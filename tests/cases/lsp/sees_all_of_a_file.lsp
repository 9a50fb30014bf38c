== yard.bt
use std

world yard {
    tick  = 100 ms
    arena = rect((0 m, 0 m), (6 m, 4 m))
    /// Where the mower lives.
    place shed: station = disc((0.6 m, 2 m), 20 cm) facing 90 deg
    place gate: station = disc((5.4 m, 2 m), 20 cm)
    robot mower {
        body  = disc(17 cm)
        drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)
        sensor eye = scanner(from = -60 deg, to = 60 deg, range = 2 m)
    }
}

/// What is left of the charge.
state charge: ratio = 100%
state loaded = false

let margin = 2 * 10 cm
let far(p: place): bool = distance(p) > 1 m + margin
let beyond(p: place, reach: length = 2 * (1 m)) = distance(p) - reach

event arrived = success(goto(gate)) and loaded

/// The battery is nearly empty.
predicate low = charge < 30%
predicate near(p: place, reach: length = 50 cm) = distance(p) <= reach

each tick { charge -= 0.1% }
on arrived { loaded = true }

/// Backs off for a while.
behavior back_off(pace: speed = 10 cm/s) {
    requires not touching
    succeed when elapsed >= 2 s
    control {
        let slow = pace / 2
        drive(speed = slow, turn = 0 rad/s)
    }
}

task mow {
    observe low, near(s in station)
    choose  goto(shed), goto(gate), back_off
    end on arrived
    end after 5 min
    reward {
        on arrived: 1
        otherwise: -0.01
    }
}

learn mow { episodes = 300 }

tree hand for mow = selector {
    low => goto(shed),
    near(gate, reach = 1 m) => back_off,
    goto(gate),
}
==
open yard.bt
symbols yard.bt
workspace ma
fold yard.bt
hints yard.bt
colours yard.bt
