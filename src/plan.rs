//! What a scene needs: one option per stage, sizes, memory, cadence, and why a stage is left out.
