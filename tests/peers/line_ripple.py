"""Waves in a lubricated line contact by linear theory: truth for the transient solver, with no step in time.

A smooth contact is solved by a dense full Newton method. A wave A exp(ik(x - Ut)) of the surface in pure rolling changes
film and pressure by δ exp(-iωt), ω = kU; linearised about the smooth solution that is one complex system,

    d/dx(U δm - δ(ρh³/12η dp/dx)) - iω δm = 0,   m = ρh,   δh = δh0 + K δp + exp(ikx),   ∫ δp dx = 0.

Wedge: third-order upwind; flow by pressure: central, mean of its coefficient; cavitation: penalty; density and viscosity:
Dowson and Higginson, Roelands. Printed: nodes, central film in nm, mean |δh|/A over |x| <= b/4. None of this is the
program's code. Needs numpy. Usage: line_ripple.py [nodes ...]   (4097 nodes: 3 GB, some minutes)
"""

import sys

import numpy as np

VISCOSITY, PRESSURE_VISCOSITY, ROELANDS = 0.04, 2.2e-8, 1.962e8
MODULUS, RADIUS = 2.0566e11 / (1 - 0.3**2), 0.01  # E' of two equal steel bodies: 2/E' = 2 (1 - nu^2)/E
CASES = {
    # Scene of src/engine/assets/evidence: load N/m, entrainment m/s, domain in b, wavelengths in b.
    "venner_1997_line": (1.10619e6, 0.67681, (-4.5, 1.5), (2, 0.5, 0.125)),
    "reference_line_m20": (1.828421e5, 0.462268, (-5.5, 2.5), (1,)),
}


def fluid(p):
    """Viscosity and density with their derivatives."""
    a = np.log(VISCOSITY) + 9.67
    z = PRESSURE_VISCOSITY * ROELANDS / a
    s = 1 + np.maximum(p, -0.5 * ROELANDS) / ROELANDS
    viscosity = VISCOSITY * np.exp(a * (s**z - 1))
    slope = viscosity * a * z / ROELANDS * s ** (z - 1)
    return viscosity, slope, 1 + 0.6e-9 * p / (1 + 1.7e-9 * p), 0.6e-9 / (1 + 1.7e-9 * p) ** 2


class Contact:
    def __init__(self, load, speed, domain, nodes):
        self.load, self.speed, n = load, speed, nodes
        self.b = np.sqrt(8 * load * RADIUS / (np.pi * MODULUS))
        self.hertz = 2 * load / (np.pi * self.b)
        self.x = np.linspace(*domain, n) * self.b
        self.dx = self.x[1] - self.x[0]
        # Deflection by pressure that is constant round each node.
        integral = lambda s: s * (np.log(np.abs(s)) - 1)
        far = np.arange(n)
        row = -4 / (np.pi * MODULUS) * self.dx * (integral(far + 0.5) - integral(far - 0.5) + np.log(self.dx))
        self.deflection = row[np.abs(np.subtract.outer(far, far))]

    def film(self, p, h0):
        return h0 + self.x**2 / (2 * RADIUS) + self.deflection @ p

    def flow(self, p, h0):
        """Flow through each face, and its derivatives by pressure and by film at every node."""
        h = self.film(p, h0)
        eta, d_eta, rho, d_rho = fluid(p)
        m, c = rho * h, rho * h**3 / (12 * eta)
        c_p, c_h = (d_rho / eta - rho * d_eta / eta**2) * h**3 / 12, 3 * c / h
        n, g = len(p) - 1, np.diff(p) / self.dx
        up = np.zeros((n, n + 1))
        i = np.arange(n)
        up[i, i], up[i[1:], i[1:]] = 1, 5 / 6
        up[i[1:], i[1:] - 1], up[i[1:], i[1:] + 1] = -1 / 6, 1 / 3
        q = self.speed * (up @ m) - 0.5 * (c[1:] + c[:-1]) * g
        by_p, by_h = self.speed * up * (d_rho * h), self.speed * up * rho
        for k, side in ((0, slice(None, -1)), (1, slice(1, None))):
            by_p[i, i + k] -= 0.5 * c_p[side] * g
            by_h[i, i + k] -= 0.5 * c_h[side] * g
        conductance = 0.5 * (c[1:] + c[:-1]) / self.dx
        by_p[i, i] += conductance
        by_p[i, i + 1] -= conductance
        return h, rho, d_rho * h, q, by_p, by_h

    def system(self, balance_p, balance_h, penalty, scale, kind=float):
        """The matrix of all unknowns: pressures over the Hertz pressure, then h0 over its scale."""
        n = len(self.x)
        a = np.zeros((n + 1, n + 1), kind)
        a[1 : n - 1, :n] = (balance_p + balance_h @ self.deflection) / scale
        a[1 : n - 1, n] = balance_h.sum(1) / scale
        inner = np.arange(1, n - 1)
        a[inner, inner] += penalty[1:-1]
        a[0, 0] = a[n - 1, n - 1] = 1 / self.hertz
        a[n, :n] = self.dx / self.load
        return a

    def smooth(self, start):
        x, n, film = self.x, len(self.x), 2e-7
        p = start(x) if start else self.hertz * np.sqrt(np.maximum(1 - (x / self.b) ** 2, 0))
        h0 = film - self.film(p, 0.0)[np.argmin(np.abs(x))]
        units = np.append(np.full(n, self.hertz), film)
        scale = self.speed * film
        for step in range(200):
            h, _, _, q, by_p, by_h = self.flow(p, h0)
            penalty = np.where(p < 0, 1e4 / self.hertz, 0)
            residual = np.zeros(n + 1)
            residual[1 : n - 1] = np.diff(q) / scale + (penalty * p)[1:-1]
            residual[0], residual[n - 1] = p[0] / self.hertz, p[-1] / self.hertz
            residual[n] = p.sum() * self.dx / self.load - 1
            if np.abs(residual).max() < 1e-9:
                return p, h0, h, penalty, scale, units
            a = self.system(np.diff(by_p, axis=0), np.diff(by_h, axis=0), penalty, scale)
            move = np.linalg.solve(a * units, -residual) * units
            part = min(1, 0.3 * self.hertz / np.abs(move[:n]).max()) if step else 0.2
            while self.film(p + part * move[:n], h0 + part * move[n]).min() < 0.3 * h.min() and part > 1e-6:
                part *= 0.6
            p, h0 = p + part * move[:n], h0 + part * move[n]
        raise SystemExit("the smooth contact did not converge")

    def wave_left(self, solution, length):
        """Mean amplitude of the film over |x| <= b/4 for a wave of amplitude 1."""
        p, h0, _, penalty, scale, units = solution
        _, rho, d_m, _, by_p, by_h = self.flow(p, h0)
        k = 2 * np.pi / length
        wave, i = np.exp(1j * k * self.x), np.arange(1, len(self.x) - 1)
        balance_p, balance_h = (np.diff(by, axis=0).astype(complex) for by in (by_p, by_h))
        balance_p[i - 1, i] -= 1j * k * self.speed * self.dx * d_m[i]
        balance_h[i - 1, i] -= 1j * k * self.speed * self.dx * rho[i]
        a = self.system(balance_p, balance_h, penalty, scale, complex)
        right = np.zeros(len(units), complex)
        right[i] = -(balance_h @ wave) / scale
        change = np.linalg.solve(a * units, right) * units
        film = change[-1] + self.deflection @ change[:-1] + wave
        return np.abs(film[np.abs(self.x) <= 0.25 * self.b + 1e-12]).mean()


def main(all_nodes):
    print("scene,nodes,wavelength_b,h_central_nm,left")
    for scene, (load, speed, domain, lengths) in CASES.items():
        start = None
        for nodes in all_nodes:
            contact = Contact(load, speed, domain, nodes)
            solution = contact.smooth(start)
            centre = 1e9 * np.interp(0, contact.x, solution[2])
            for length in lengths:
                left = contact.wave_left(solution, length * contact.b)
                print(f"{scene},{nodes},{length},{centre:.2f},{left:.4f}", flush=True)
            start = lambda x, c=contact, p=solution[0]: np.maximum(np.interp(x, c.x, p), 0)


main([int(text) for text in sys.argv[1:]] or [513, 1025, 2049])
