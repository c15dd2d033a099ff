"""Many poses of one mechanism each, as an engineer would write them for numba: one fast loop.

A four-bar and a slider-crank by the closed formulas of their loop, and the construction of Rosenauer's closed
eight-link chain (No. 15), step by step as in `by_hand_python`: each for its scene and no other, of small functions that
the compiler inlines. One thread, and nothing reordered (no fastmath); a division by zero gives nan.

Each reads complex arrays of shape (n,), a point each, and gives velocities and accelerations (mm and s) of shape
(points, n) in the same order.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.complex128]
Seven = tuple[complex, complex, complex, complex, complex, complex, complex]

O, N, M = 0j, -220 - 30j, 145 - 95j  # the pivots of the frame
OMEGA = 10.0  # of the crank O F G, rad/s, uniform


@njit(error_model="numpy")
def cross(u: complex, v: complex) -> float:
    """The component of v across u, times the length of u."""
    return u.real * v.imag - u.imag * v.real


@njit(error_model="numpy")
def dot(u: complex, v: complex) -> float:
    """The component of v along u, times the length of u."""
    return u.real * v.real + u.imag * v.imag


@njit(error_model="numpy")
def times(u: complex, s: float) -> complex:
    """The vector u, s times as long."""
    return complex(u.real * s, u.imag * s)


@njit(error_model="numpy")
def turned(u: complex) -> complex:
    """The vector u, a quarter turned."""
    return complex(-u.imag, u.real)


@njit(error_model="numpy")
def square(u: complex) -> float:
    """The square of the length of u."""
    return u.real * u.real + u.imag * u.imag


@njit(error_model="numpy")
def meet(P: complex, u: complex, S: complex, v: complex) -> complex:
    """Where the line through P along u meets the one through S along v."""
    return P + times(u, cross(S - P, v) / cross(u, v))


@njit(error_model="numpy")
def normal(u: complex, l: complex) -> complex:
    """The relative normal acceleration by the semicircle over the side l, u being the relative velocity."""
    return times(l, square(u) / square(l))


@njit(error_model="numpy")
def eight_link(F: Array, G: Array, A: Array, B: Array, C: Array, D: Array, E: Array) -> tuple[Array, Array]:
    """The chain of the scene `alt-eight-link`."""
    v, a = np.empty((7, len(F)), np.complex128), np.empty((7, len(F)), np.complex128)
    for i in range(len(F)):
        u, j = one_pose(F[i], G[i], A[i], B[i], C[i], D[i], E[i])
        for k in range(7):
            v[k, i] = -turned(times(u[k], OMEGA))
            a[k, i] = times(j[k], OMEGA * OMEGA)
    return v, a


@njit(error_model="numpy")
def one_pose(F: complex, G: complex, A: complex, B: complex, C: complex, D: complex, E: complex) -> tuple[Seven, Seven]:
    """The orthogonal velocities and the accelerations at the scale at which those of F are FO."""
    # Ends of the orthogonal velocities: those of F and G lie in O, those of N and M stay where they are.
    Q = meet(F, B - F, N, A - N)
    R = meet(G, E - G, M, D - M)
    v_q = meet(N, A - N, O, B - F)
    v_r = meet(M, D - M, O, E - G)
    v_c = meet(v_q, C - Q, v_r, C - R)
    v_a = meet(v_c, A - C, N, A - N)
    v_b = meet(v_c, B - C, O, B - F)
    v_d = meet(v_c, D - C, M, D - M)
    v_e = meet(v_c, E - C, O, E - G)
    u_a, u_b, u_c, u_d, u_e, u_f, u_g = v_a - A, v_b - B, v_c - C, v_d - D, v_e - E, O - F, O - G

    # The plan of relative normal accelerations, from c: abc and cde are similar to the links ABC and CDE.
    ca, cd = normal(u_a - u_c, A - C), normal(u_d - u_c, D - C)
    s_3, s_6 = square(u_a - u_c) / square(A - C), square(u_d - u_c) / square(D - C)
    a, b, d, e = ca, times(B - C, s_3), cd, times(E - C, s_6)
    f, n = b - normal(u_b - u_f, B - F), a - normal(u_a, A - N)
    g, m = e - normal(u_e - u_g, E - G), d - normal(u_d, D - M)
    f_1, g_1 = f + u_f, g + u_g

    # alpha, beta, delta and epsilon are perpendicular to NA, FB, MD and GE; between each two a trial triangle.
    alpha, beta, delta, epsilon = turned(A - N), turned(B - F), turned(D - M), turned(E - G)
    U_1, U_2 = meet(n, alpha, f_1, beta), meet(m, delta, g_1, epsilon)
    A_1 = meet(n, alpha, f_1 - turned(B - A), beta)
    D_1 = meet(m, delta, g_1 - turned(E - D), epsilon)
    B_1, C_1 = A_1 + turned(B - A), A_1 + turned(C - A)
    E_1, C_2 = D_1 + turned(E - D), D_1 + turned(C - D)
    s_1 = cross(U_2 - U_1, C_2 - U_2) / cross(C_1 - U_1, C_2 - U_2)
    s_2 = cross(U_2 - U_1, C_1 - U_1) / cross(C_1 - U_1, C_2 - U_2)
    j_a, j_b, j_c = U_1 + times(A_1 - U_1, s_1) - a, U_1 + times(B_1 - U_1, s_1) - b, U_1 + times(C_1 - U_1, s_1)
    j_d, j_e = U_2 + times(D_1 - U_2, s_2) - d, U_2 + times(E_1 - U_2, s_2) - e
    return (u_f, u_g, u_a, u_b, u_c, u_d, u_e), (u_f, u_g, j_a, j_b, j_c, j_d, j_e)


@njit(error_model="numpy")
def four_bar(A: Array, B: Array, M: Array) -> tuple[Array, Array]:
    """Crank OA, coupler ABM, rocker BC of the scene `four-bar`."""
    C, v, a = 310 + 0j, np.empty((3, len(A)), np.complex128), np.empty((3, len(A)), np.complex128)
    for i in range(len(A)):
        AB, CB, AM = B[i] - A[i], B[i] - C, M[i] - A[i]
        v_A, a_A = times(turned(A[i]), OMEGA), times(A[i], -OMEGA * OMEGA)
        omega = -dot(v_A, CB) / cross(AB, CB)  # v_A + i omega AB is perpendicular to CB
        v_B = v_A + times(turned(AB), omega)
        n = a_A - times(AB, omega * omega) + times(CB, square(v_B) / square(CB))
        alpha = -dot(n, CB) / cross(AB, CB)
        v[0, i], v[1, i], v[2, i] = v_A, v_B, v_A + times(turned(AM), omega)
        a[0, i], a[1, i] = a_A, a_A + times(turned(AB), alpha) - times(AB, omega * omega)
        a[2, i] = a_A + times(turned(AM), alpha) - times(AM, omega * omega)
    return v, a


@njit(error_model="numpy")
def slider_crank(A: Array, B: Array, S: Array) -> tuple[Array, Array]:
    """Crank OA and rod ABS of the scene `slider-crank`, whose block slides along x."""
    v, a = np.empty((3, len(A)), np.complex128), np.empty((3, len(A)), np.complex128)
    for i in range(len(A)):
        AB, AS = B[i] - A[i], S[i] - A[i]
        v_A, a_A = times(turned(A[i]), OMEGA), times(A[i], -OMEGA * OMEGA)
        omega = -v_A.imag / AB.real  # v_A + i omega AB is along x
        alpha = (omega * omega * AB.imag - a_A.imag) / AB.real
        v[0, i], v[1, i] = v_A, complex(v_A.real - omega * AB.imag, 0.0)
        v[2, i] = v_A + times(turned(AS), omega)
        a[0, i], a[1, i] = a_A, complex(a_A.real - alpha * AB.imag - omega * omega * AB.real, 0.0)
        a[2, i] = a_A + times(turned(AS), alpha) - times(AS, omega * omega)
    return v, a


LOOPS = {"four-bar": four_bar, "slider-crank": slider_crank, "alt-eight-link": eight_link}
