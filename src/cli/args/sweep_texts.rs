//! The help of sweeps.

/// What a sweep is.
pub(super) const SWEEP_ABOUT: &str = "\
Run many cases of a scene; write one table with a row for each, and plots.

A sweep file names a scene and what varies: [vary] takes any keys of a scene, each with a list of values or a
range { from, to, n, spacing = \"linear\" or \"log\" }. Several keys make a grid (every combination; the default)
or, with combine = \"list\", vary together. Instead of [vary], [gear] follows a tooth along its line of action,
[race] a ball through its loaded zone, [cam] a cam's flank. asperity sweep slide_roll --show file prints one.

Cases that differ only in S or an amplitude start from each other's final state, in chains of at most [chain] longest
cases; a chain begins cold. The file alone determines the chains, so the table is the same byte for byte whoever runs
which, on machines of one kind: CPUs with other vector units differ by rounding (about 1e-7). Every case is written whole
or not at all: after an interruption --resume continues. Started several times with --resume on one folder, here or on
machines that share it, each process takes the next chain that nobody has.

The folder must be new, empty or marked by a sweep (sweep.digest); --force removes the sweep's own files in it and no
others.";

/// How it is asked for.
pub(super) const SWEEP_EXAMPLES: &str = "\
Built in: slide_roll, random_rollers, two_rough_discs, pits_and_wear, life_map, stribeck, lambda,
fzg_c, bearing_race, cam_flank.

Examples:
  asperity sweep slide_roll                      the default scene at 21 values of S, into ./slide_roll.sweep/
  asperity sweep slide_roll --show file > mine.toml    a file to edit
  asperity sweep mine.toml --resume              continues after an interruption; helps a sweep that runs
  asperity sweep status mine.sweep               how far it is, and who works on it
  asperity sweep mine.toml --show manifest       the chains and their estimated costs
  asperity sweep mine.toml --chain 3             chain 3 alone, for an engine that shares chains out
  asperity sweep collect mine.sweep              the table, when all chains are there
  asperity sweep collect one.sweep two.sweep --out all.sweep
  asperity sweep slide_roll --compare-cold       what the chains save, and what they cost in accuracy
  asperity sweep fzg_c --show ride > ride.toml   then asperity run ride.toml: a recording along the tooth
  asperity sweep fzg_c --show points             R, U1, U2, S, load, p_h, film along the path; no simulation

Exit codes: 0 all converged; 1 bad input; 2 some cases did not converge; 3 some stalled, or cases are missing;
4 an output failed; 5 it was stopped (Ctrl-C, SIGTERM, SIGHUP).";
