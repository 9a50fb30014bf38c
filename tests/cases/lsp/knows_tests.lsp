== yard.bt
predicate low
/// Fills the battery.
behavior charge
behavior fetch

tree work = selector { low => charge, fetch }

test "charges first" of work {
    given low
    tick => charge succeeds
    tick not low => fetch, work runs
}
==
open yard.bt
symbols yard.bt
hover yard.bt tick => ch|arge
definition yard.bt of wo|rk
references yard.bt behavior ch|arge
rename yard.bt given lo|w ~> empty
complete yard.bt     gi|ven low
complete yard.bt given |low
complete yard.bt tick => |charge
complete yard.bt of |work
colours yard.bt
