// The rows of the reality study: each plays its scenes and adds its lines.
#pragma once

namespace taut::reality {

class Bench;

// Strips at rest.
void holdCantilever(Bench& bench);
void holdFabrics(Bench& bench);
void holdTipLoad(Bench& bench);
void holdLoops(Bench& bench);
void holdColumn(Bench& bench);
void holdCreases(Bench& bench);
// Cloth over a disc.
void holdDrape(Bench& bench);
// Loss of stability of rest states.
void holdStanding(Bench& bench);
void holdLateral(Bench& bench);
void holdStickSlip(Bench& bench);
void holdFriction(Bench& bench);
// Sheets that a pressure blows up.
void holdDisc(Bench& bench);
void holdBall(Bench& bench);
void holdMylar(Bench& bench);
// In motion.
void holdStripModes(Bench& bench);
void holdChainModes(Bench& bench);
void holdFoldedChain(Bench& bench);

}  // namespace taut::reality
