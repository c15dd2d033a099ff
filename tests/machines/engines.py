"""Engines and what moves their valves."""

from __future__ import annotations

from machine import Points, machine, reach, tip, turn


@machine("OA AB AC B C frame:O", slides="4 along frame at B on 1,1; 5 along frame at C on -1,1", at=(40, 215))
def v_engine(t: float) -> Points:
    O, A = 0j, 30 * turn(t)
    B, C = reach(A, 110, O, 1 + 1j), reach(A, 110, O, -1 + 1j)
    return locals()


@machine("OA ABKL KC LD B C D frame:O", at=(50, 260),
         slides="5 along frame at B on OB; 6 along frame at C on OC; 7 along frame at D on OD")
def radial_engine(t: float) -> Points:
    O, A = 0j, 30 * turn(t)
    B = reach(A, 120, O, 1j)
    u = (B - A) / 120
    K, L = A + 20 * u * turn(120), A + 20 * u * turn(-120)
    C, D = reach(K, 100, O, turn(210)), reach(L, 100, O, turn(-30))
    return locals()


@machine("OA ABC PB CD D frame:OP", slides="5 along frame at D on 1,0", at=(60, 250))
def atkinson_engine(t: float) -> Points:
    O, P, A = 0j, 60 - 90j, 30 * turn(t)
    B = tip(P, 70, A, 100)
    C = B + (B - A) * 0.15 * turn(40)
    D = reach(C, 150, 10j, 1)
    return locals()


@machine("OAC AB BK CD PD E EFL QL FGH G HK frame:OPQ",
         slides="3 along frame at B on 1,0; 6 along 5 at E on PD; 10 along frame at G on 1,0")
def walschaerts_valve_gear() -> Points:
    O, P, Q, A, C = 0j, -120 + 60j, -150 + 130j, 30 + 40j, -20 + 15j
    B, K, D = -250 + 0j, -248 - 40j, -114 - 6j
    E, L, F, G, H = -122 + 82j, -146 + 84j, -291 + 100j, -290 + 85j, -286 - 35j
    return locals()


@machine("OAC AF CG FGH QH D DT frame:OQ",
         slides="6 along 4 at D on FG; 7 along frame at T on 1,0")
def stephenson_link_motion() -> Points:
    O, Q, A, C = 0j, -140 + 90j, -15 + 22j, -17 - 20j
    F, G, H, D, T = -150 + 40j, -154 - 40j, -160 + 4j, -151 + 20j, -230 + 20j
    return locals()


@machine("OAE AB B EF F frame:O", slides="3 along frame at B on 1,0; 5 along frame at F on 1,0", at=(35, 150))
def opposed_piston_engine(t: float) -> Points:
    O, A = 0j, 40 * turn(t)
    E = 25 * turn(t + 170)
    B, F = reach(A, 130, O, 1), reach(E, 120, O, -1)
    return locals()


@machine("OA AB PBC CD D frame:OP", slides="5 along frame at D on 0,1", at=(60, 200))
def side_lever_engine(t: float) -> Points:
    O, P, A = 0j, 150 - 40j, 40 * turn(t)
    B = tip(A, 130, P, 120)
    C = P + (P - B) * 0.9
    D = reach(C, 140, 255 + 0j, 1j)
    return locals()
