"""Chains of six links and more, all pins: Watt, Stephenson, walking legs, inversors, Kempe."""

from __future__ import annotations

from machine import Points, machine, mirror, tip, turn


@machine("OAC ABD PB CE ED frame:OP", at=(60, 110))
def watt_one(t: float) -> Points:
    O, P, A, C = 0j, 120 + 0j, 50 * turn(t), 90 * turn(t + 25)
    B = tip(A, 100, P, 80)
    D = A + (B - A) * (0.6 + 0.7j)
    E = tip(C, 70, D, 60)
    return locals()


@machine("OA AB PBC CD QD frame:OPQ", at=(60, 310))
def watt_two(t: float) -> Points:
    O, P, Q, A = 0j, 120 + 0j, 230 + 10j, 40 * turn(t)
    B = tip(A, 110, P, 70)
    C = P + (B - P) * turn(-60)
    D = tip(C, 105, Q, 75)
    return locals()


@machine("OBC BD PDE CF FE frame:OP", at=(70, 100))
def stephenson_one(t: float) -> Points:
    O, P, B, C = 0j, 120 + 0j, 60 * turn(t), 90 * turn(t + 30)
    D = tip(B, 100, P, 70)
    E = P + (D - P) * 1.4 * turn(-25)
    F = tip(C, 130, E, 120)
    return locals()


@machine("PA ADE BD CE OBC frame:OP")
def stephenson_two() -> Points:
    P, O, A = 0j, 150 + 0j, -20 + 45j
    D, E, B, C = 30 + 90j, -5 + 120j, 120 + 70j, 110 + 160j
    return locals()


@machine("OA ABC PB CD QD frame:OPQ", at=(60, 200))
def stephenson_three(t: float) -> Points:
    O, P, Q, A = 0j, 120 + 0j, 200 + 90j, 40 * turn(t)
    B = tip(A, 110, P, 80)
    C = A + (B - A) * (0.6 + 0.5j)
    D = tip(C, 150, Q, 80)
    return locals()


@machine("QD OA ABC PB CD frame:OPQ")
def stephenson_three_by_its_dyad() -> Points:
    O, P, Q = 0j, 120 + 0j, 230 + 60j
    A, B, C, D = -10 + 40j, 115 + 85j, 55 + 110j, 180 + 120j
    return locals()


@machine("NA ABC BF OFG GE CDE DM frame:NOM")
def double_butterfly() -> Points:
    N, O, M = 0j, 200 - 210j, 380 + 240j
    A, B, C, D, E, F, G = -12 + 50j, 90 + 150j, 30 + 270j, 250 + 290j, 230 + 200j, 60 + 25j, 310 + 15j
    return locals()


@machine("OA AC AB PBD PC DE CEF frame:OP", at=(40, 200))
def jansen_leg(t: float) -> Points:
    O, P, A = 0j, -38 - 7.8j, 15 * turn(t)
    B, C = tip(P, 41.5, A, 50), tip(A, 61.9, P, 39.3)
    D = tip(P, 40.1, B, 55.8)
    E = tip(C, 36.7, D, 39.4)
    F = tip(C, 49, E, 65.7)
    return locals()


@machine("OA AC AB PBD PC DE CEF AG AH QGI QH IJ HJK frame:OPQ", at=(95, 310))
def pair_of_jansen_legs(t: float) -> Points:
    def leg(A: complex) -> tuple[complex, ...]:
        B, C = tip(P, 41.5, A, 50), tip(A, 61.9, P, 39.3)
        D = tip(P, 40.1, B, 55.8)
        E = tip(C, 36.7, D, 39.4)
        return B, C, D, E, tip(C, 49, E, 65.7)

    O, P, Q, A = 0j, -38 - 7.8j, 38 - 7.8j, 15 * turn(t)
    B, C, D, E, F = leg(A)
    G, H, I, J, K = (-z.conjugate() for z in leg(15 * turn(180 - t)))
    return locals()


@machine("OM MCD BC AE DEF frame:OAB")
def klann_leg() -> Points:
    O, A, B, M = 160 + 75j, 137 + 137j, 101 + 57j, 133 + 75j
    C, D, E, F = 75 + 73j, 23 + 87j, 87 + 137j, 0j
    return locals()


@machine("PA AB AC OB OC BD CD frame:OP", at=(40, -65))
def peaucellier(t: float) -> Points:
    O, P = 0j, 45 + 0j
    A = P + 45 * turn(t)
    B, C = tip(O, 100, A, 40), tip(A, 40, O, 100)
    D = mirror(A, B, C)
    return locals()


@machine("SP APD AOB CD BCQ frame:OS")
def hart_inversor() -> Points:
    A, B, C, D = -60 + 0j, 20 + 40j, 60 + 0j, -20 + 40j
    O, P, Q, S = -20 + 20j, -40 + 20j, 40 + 20j, -30 - 10j
    return locals()


@machine("OR PQ RSQ OT TS frame:OP", at=(50, 115))
def kempe_reversor(t: float) -> Points:
    O, P, R, T = 0j, 100 + 0j, 60 * turn(t), 36 * turn(2 * t)
    Q, S = mirror(P + R, P, R), mirror(R + T, R, T)
    return locals()


@machine("OR PQ RSQ OT TUS OV VU frame:OP", at=(35, 50))
def kempe_trisector(t: float) -> Points:
    O, P, R, T, V = 0j, 100 + 0j, 60 * turn(t), 36 * turn(2 * t), 21.6 * turn(3 * t)
    Q, S, U = mirror(P + R, P, R), mirror(R + T, R, T), mirror(T + V, T, V)
    return locals()


@machine("OA PB AB AC BD CDE frame:OP", drives="1 4", at=((100, 30), (60, -20)))
def kempe_translator(s: float, t: float) -> Points:
    O, P, A = 0j, 30 + 10j, 80 * turn(s)
    C = A + 90 * turn(t)
    B, D, E = P + A, P + C, C + 25 - 20j
    return locals()


@machine("OA AB PBDE EF DG FG QG frame:OPQ", at=(30, 140))
def watt_beam_engine(t: float) -> Points:
    O, P, Q, A = 0j, 300 + 500j, 605 + 340j, 90 * turn(t)
    B = tip(A, 490, P, 300)
    D, E = P - (B - P) / 2, P - (B - P)
    G = tip(Q, 150, D, 160)
    F = E + G - D
    return locals()


@machine("OA OC CD DAE GH AHI IJ EJ frame:OG", drives="1 2", at=((100, 200), (70, 160)))
def palletizing_robot(s: float, t: float) -> Points:
    O, G, A, C = 0j, -60 + 20j, 300 * turn(s), 80 * turn(t)
    D, H, E = A + C, A + G, A - C * 4
    I = A + 30 + 60j
    J = E + I - A
    return locals()
