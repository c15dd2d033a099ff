"""Lifting, digging and loading machines: what cylinders move. Their poses are placed by the cylinders' lengths."""

from __future__ import annotations

from machine import Points, machine, seat, tip, towards, turn


@machine("body:OAT cylinder:Q rod:A frame:OQ", slides="rod along cylinder at A on QA", drives="rod/cylinder",
         at=(190, 240))
def dump_truck(t: float) -> Points:
    O, Q = 0j, 200 - 40j
    A = tip(O, 180, Q, t)
    T = towards(O, 400, A)
    return locals()


ARM = dict(slides="r1 along c1 at C on BC; r2 along c2 at E on DE; r3 along c3 at T on HT", drives="r1/c1 r2/c2 r3/c3")


@machine("boom:OCDF stick:FEHQG bucket:GUM rocker:QT link:TU c1:B r1:C c2:D r2:E c3:H r3:T frame:OB", **ARM,
         at=((300, 130, 190), (270, 115, 205)))
def excavator(a: float, b: float, c: float) -> Points:
    O, B = 0j, 60 - 40j
    C = tip(O, 315, B, a)
    D, F = seat(O, C, 360), seat(O, C, 450 - 120j)
    E = tip(D, b, F, 100)
    H, Q, G = seat(F, E, 20 + 30j), seat(F, E, -170 + 20j), seat(F, E, -210)
    T = tip(H, c, Q, 45)
    U = tip(T, 45, G, 40)
    M = seat(G, U, 50 - 60j)
    return locals()


@machine("boom:OCDF dipper:FEHG bucket:GTM c1:B r1:C c2:D r2:E c3:H r3:T frame:OB", **ARM,
         at=((170, 150, 150), (185, 165, 140)))
def backhoe(a: float, b: float, c: float) -> Points:
    O, B = 0j, 30 + 90j
    C = tip(O, 190, B, a)
    D, F = seat(O, C, 130 + 40j), seat(O, C, 260 - 20j)
    E = tip(F, 60, D, b)
    G, H = seat(F, E, -190 + 20j), seat(F, E, 30 + 30j)
    T = tip(G, 50, H, 150 + c / 5)
    M = seat(G, T, -30 + 60j)
    return locals()


@machine("arm:OAJP bell:SJT link:TU bucket:PUV c1:Q r1:A c2:R r2:S frame:OQR", drives="r1/c1 r2/c2",
         slides="r1 along c1 at A on QA; r2 along c2 at S on RS", at=((140, 130), (165, 150)))
def front_loader_z_bar(a: float, b: float) -> Points:
    O, Q, R = 0j, 10 - 70j, 20 + 30j
    A = tip(O, 150, Q, a)
    J, P = seat(O, A, 190 + 10j), seat(O, A, 290 - 70j)
    S = tip(R, b, J, 80)
    T = seat(J, S, -75 + 10j)
    U = tip(T, 70, P, 40)
    V = seat(P, U, 20 - 90j)
    return locals()


@machine("boom:OA second:E third:F cylinder:Q rod:A frame:OQ", at=((90, 250, 300), (110, 280, 350)),
         slides="rod along cylinder at A on QA; second along boom at E on OE; third along second at F on EF",
         drives="rod/cylinder second/boom third/second")
def telescopic_boom(a: float, e: float, f: float) -> Points:
    O, Q = 0j, 80 - 30j
    A = tip(O, 120, Q, a)
    E, F = towards(O, e, A), towards(O, f, A)
    return locals()


@machine("boom:OA second:EDH jib:HKF cylinder:Q rod:A c2:D r2:K frame:OQ", at=((90, 250, 100), (110, 280, 120)),
         slides="rod along cylinder at A on QA; second along boom at E on OE; r2 along c2 at K on DK",
         drives="rod/cylinder second/boom r2/c2")
def telescopic_loader_with_jib(a: float, e: float, b: float) -> Points:
    O, Q = 0j, 80 - 30j
    A = tip(O, 120, Q, a)
    E = towards(O, e, A)
    D, H = seat(E, O, 60 + 20j), seat(E, O, -50)
    K = tip(H, 60, D, b)
    F = seat(H, K, 100 - 120j)
    return locals()


def scissors(stages: int, foot: float) -> Points:
    """The bars' ends at each level, left L and right R, and their crossings X."""
    height = (200**2 - foot**2) ** 0.5
    ends = {f"L{k}": 1j * k * height for k in range(stages + 1)} | {f"R{k}": foot + 1j * k * height for k in range(stages + 1)}
    return ends | {f"X{k}": foot / 2 + 1j * (k + 0.5) * height for k in range(stages)}


@machine("L0X0KR1 R0X0L1 foot:R0 top:L1T head:R1 cylinder:O rod:K frame:L0O", drives="rod/cylinder", at=(170, 120),
         slides="foot along frame at R0 on 1,0; head along top at R1 on 1,0; rod along cylinder at K on OK")
def scissor_lift(foot: float) -> Points:
    L0, L1, R0, R1, X0 = scissors(1, foot).values()
    O, K, T = 60 - 20j, towards(L0, 130, R1), L1 + 80 + 10j
    return locals()


@machine("L0X0KR1 R0X0L1 L1X1R2 R1X1L2 L2X2R3 R2X2L3 foot:R0 top:L3T head:R3 cylinder:O rod:K frame:L0O",
         drives="rod/cylinder", at=(170, 120),
         slides="foot along frame at R0 on 1,0; head along top at R3 on 1,0; rod along cylinder at K on OK")
def scissor_lift_of_three_stages(foot: float) -> Points:
    L0, L1, L2, L3, R0, R1, R2, R3, X0, X1, X2 = scissors(3, foot).values()
    O, K, T = 60 - 20j, towards(L0, 130, R1), L3 + 80 + 10j
    return locals()


@machine("L0X0R1 R0X0L1 foot:R0 top:L1T head:R1 wedge:W roller:X0 frame:L0", drives="wedge/frame", at=(170, 120),
         slides="foot along frame at R0 on 1,0; head along top at R1 on 1,0; wedge along frame at W on 1,0; "
                "roller along wedge at X0 on 4,1")
def aerial_scissor_with_wedge(foot: float) -> Points:
    L0, L1, R0, R1, X0 = scissors(1, foot).values()
    W, T = 40 - 30j, L1 + 80 + 10j
    return locals()


@machine("lower:OBA upper:PDC post:ACE c:Q r:B frame:OPQ", slides="r along c at B on QB", drives="r/c", at=(120, 150))
def parallel_lift(t: float) -> Points:
    O, P, Q = 0j, 60j, 60 - 50j
    B = tip(O, 130, Q, t)
    A = towards(O, 250, B)
    C, D, E = A + P, P + B, A + 80 + 100j
    return locals()


@machine("boom:OCDN first:NEGT second:GKS c1:B r1:C c2:D r2:E c3:T r3:K frame:OB",
         slides="r1 along c1 at C on BC; r2 along c2 at E on DE; r3 along c3 at K on TK", drives="r1/c1 r2/c2 r3/c3",
         at=((250, 170, 120), (280, 190, 135)))
def concrete_pump_arm(a: float, b: float, c: float) -> Points:
    O, B = 0j, 60 - 20j
    C = tip(O, 240, B, a)
    D, N = seat(O, C, 250 + 30j), seat(O, C, 400)
    E = tip(D, b, N, 50)
    G, T = seat(N, E, -60 - 300j), seat(N, E, -10 - 170j)
    K = tip(G, 45, T, c)
    S = seat(G, K, 200 - 200j)
    return locals()


@machine("left:OAC right:PBD c1:A r1:B frame:OP", drives="left r1/c1", slides="r1 along c1 at B on AB", at=((100, 90), (80, 70)))
def clamshell_grab(s: float, length: float) -> Points:
    O, P = 0j, 40 + 0j
    A = O + 60 * turn(s)
    B = tip(A, length, P, 60)
    C, D = O - A / 2 + 20j, P - (B - P) / 2 + 20j
    return locals()


@machine("left:OAC right:OBD c1:A r1:B frame:O", drives="left r1/c1", slides="r1 along c1 at B on AB", at=((150, 90), (120, 70)))
def cylinder_between_two_arms_on_one_pin(s: float, length: float) -> Points:
    O, A = 0j, 60 * turn(s)
    B = tip(A, length, O, 60)
    C, D = -1.5 * A, -1.5 * B
    return locals()


@machine("OAM AB PBN c:M r:N frame:OP", drives="r/c", slides="r along c at N on MN")
def four_bar_moved_by_a_cylinder_between_its_arms() -> Points:
    O, P, A, B = 0j, 80 + 0j, -10 + 60j, 75 + 70j
    M, N = -20 + 15j, 80 + 90j
    return locals()
