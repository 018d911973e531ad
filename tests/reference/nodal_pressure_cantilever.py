#!/usr/bin/env python3
"""First bending period of the cantilever of tests/verification/test_solid_tetrahedra.cpp (8 x 1 x 1, E = rho = 1) over
that of Euler & Bernoulli's beam, from the linear stiffness of published tetrahedra: plain (constant strain), average
nodal pressure (Bonet & Burton 1998, Commun. Numer. Meth. Engng 14, 437-449: the volume strain of a node is that of
all tetrahedra around it, the rest is each tetrahedron's own), and nodal strain (Dohrmann et al. 2000, IJNME 47,
1549-1568: the whole strain is the node's). Needs numpy and scipy.
"""
import sys
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla


def mesh(fine):
    n = (8 * fine, fine, fine)
    node = lambda i, j, k: i + (n[0] + 1) * (j + (n[1] + 1) * k)
    places = np.array([[i / fine, j / fine, k / fine] for k in range(n[2] + 1) for j in range(n[1] + 1)
                       for i in range(n[0] + 1)])
    tets = []
    around = [1, 2, 3, 7, 4, 5]
    for k in range(n[2]):
        for j in range(n[1]):
            for i in range(n[0]):
                c = [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                     node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)]
                for s in range(6):
                    tets.append([c[0], c[around[s]], c[around[(s + 1) % 6]], c[6]])
    return places, np.array(tets)


def period(kind, nu, fine):
    x, tets = mesh(fine)
    shear, bulk = 1 / (2 * (1 + nu)), 1 / (3 * (1 - 2 * nu))
    count, cells = len(x), len(tets)
    edges = x[tets[:, 1:]] - x[tets[:, :1]]
    volume = np.linalg.det(edges) / 6
    assert np.all(volume > 0)
    inverse = np.linalg.inv(edges)  # column i: gradient of corner i + 1
    gradient = np.empty((cells, 4, 3))
    gradient[:, 1:] = np.transpose(inverse, (0, 2, 1))
    gradient[:, 0] = -gradient[:, 1:].sum(axis=1)
    # Strain (xx yy zz xy yz zx, engineering) of each tetrahedron.
    rows, cols, vals = [], [], []
    pairs = [(0, 0, 0), (1, 1, 1), (2, 2, 2), (3, 0, 1), (3, 1, 0), (4, 1, 2), (4, 2, 1), (5, 2, 0), (5, 0, 2)]
    for corner in range(4):
        for part, component, direction in pairs:
            rows.append(6 * np.arange(cells) + part)
            cols.append(3 * tets[:, corner] + component)
            vals.append(gradient[:, corner, direction])
    strain = sp.csr_matrix((np.concatenate(vals), (np.concatenate(rows), np.concatenate(cols))),
                           shape=(6 * cells, 3 * count))
    nodal = np.zeros(count)
    np.add.at(nodal, tets.ravel(), np.repeat(volume / 4, 4))
    mean = sp.csr_matrix((np.repeat(volume / 4, 4) / nodal[tets.ravel()],
                          (tets.ravel(), np.repeat(np.arange(cells), 4))), shape=(count, cells))
    deviator = shear * (np.diag([2, 2, 2, 1, 1, 1]) - np.pad(np.full((3, 3), 2 / 3), (0, 3)))
    pressure = np.pad(np.full((3, 3), bulk), (0, 3))
    of_cells = lambda law: strain.T @ sp.kron(sp.diags(volume), law) @ strain
    averaged = sp.kron(mean, sp.identity(6)) @ strain
    of_nodes = lambda law: averaged.T @ sp.kron(sp.diags(nodal), law) @ averaged
    stiffness = {"plain": lambda: of_cells(deviator + pressure),
                 "nodal pressure": lambda: of_cells(deviator) + of_nodes(pressure),
                 "nodal strain": lambda: of_nodes(deviator + pressure)}[kind]()
    free = np.repeat(x[:, 0] > 0, 3)
    k, m = stiffness[free][:, free].tocsc(), np.repeat(nodal, 3)[free]
    root = sp.diags(1 / np.sqrt(m))
    square = sla.eigsh((root @ k @ root).tocsc(), k=2, sigma=0, return_eigenvectors=False)
    beam = 3.516 * np.sqrt(1 / 12) / 64
    return sorted(beam / np.sqrt(square))


for fine in map(int, sys.argv[1:] or ["2", "4"]):
    for kind in ("plain", "nodal pressure", "nodal strain"):
        print(fine, kind, *("nu {}: {:.3f} {:.3f}".format(nu, *period(kind, nu, fine)) for nu in (0.3, 0.49)))
