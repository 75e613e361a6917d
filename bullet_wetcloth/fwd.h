// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

// Names of the public classes, for headers that need no more: an application that declares them itself would have to
// name the inline namespace of its precision.

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class WetClothWorld;
class WetCloth;
class Effect;
struct Fabric;
struct Step;
enum class Hook;
enum class Stage;

class ClothSolver;

class Absorption;
class Cling;
class CollisionAudit;
class ContactWetting;
class Diffusion;
class Dripping;
class Drying;
class HookeSprings;
class Immersion;
class Rain;
class Seepage;
class Splash;
class Swelling;
class WaterDrag;
class WetFriction;
class WetStiffness;
class Wind;

class Drops;
class WorldPart;
struct Drop;
struct DropAir;
struct Glass;
struct Landing;
struct Pour;
struct WorldLedger;

class Exposure;
class WindField;
struct WaterSurface;
struct AuditTotals;
struct Drip;
struct Passage;

class Water;
class NodeMasses;
class LinkConstants;
struct Ledger;

class RestMesh;
struct ClothPatch;

struct Colour;
struct VertexAttribute;
struct VertexBuffer;

class StateArchive;
class StateError;

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
