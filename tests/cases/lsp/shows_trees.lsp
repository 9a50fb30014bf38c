== yard.bt
use std

world yard {
    tick  = 100 ms
    arena = rect((0 m, 0 m), (6 m, 4 m))
    place shed = disc((0.6 m, 2 m), 20 cm)
    place gate = disc((5.4 m, 2 m), 20 cm)
    robot mower {
        body  = disc(17 cm)
        drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)
    }
}

state charge: ratio = 100%
each tick { charge -= 0.1% }
event home = success(goto(shed))
on home { charge = 100% }
predicate low = charge < 30%

task mow {
    observe low
    choose  goto(shed), goto(gate)
    end after 5 min
    reward { on home: 1 }
}

learn mow { episodes = 300 }

tree back(to: place) = goto(to)

tree `by hand` for mow = selector {
    low => back(shed),
    goto(gate),
}
== several.bt
use "yard.bt"

task rest {
    observe low
    choose  goto(shed), goto(gate)
    end after 5 min
    reward { on home: 1 }
}

learn fast for rest { episodes = 30 }
learn slow for rest { episodes = 3_000 }

tree idle for rest = goto(shed)
tree stray = goto(gate)
tree busy for rest = memory sequence { goto(gate), goto(shed) }
== none.bt
use std
==
open yard.bt
lenses yard.bt
tree yard.bt
tree yard.bt low => ba|ck(shed)
tree yard.bt by hand
tree yard.bt by foot
change yard.bt goto(gate),\n} ~> not low => goto(gate),\n    wait,\n}
tree yard.bt by hand
change yard.bt state charge ~> state chrge
tree yard.bt by hand
change yard.bt state chrge ~> state charge
tree several.bt busy
tree nowhere.bt
open several.bt
lenses several.bt
tree several.bt
tree several.bt memory sequ|ence
tree several.bt observe l|ow
tree several.bt by hand
open none.bt
lenses none.bt
tree none.bt
