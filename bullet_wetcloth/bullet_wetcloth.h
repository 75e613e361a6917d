#pragma once

// Everything that an application needs to make its Bullet cloth wet.

#include "bullet_wetcloth/Fabric.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/effects/Absorption.h"
#include "bullet_wetcloth/effects/CollisionAudit.h"
#include "bullet_wetcloth/effects/HookeSprings.h"
#include "bullet_wetcloth/effects/Wind.h"
#include "bullet_wetcloth/mesh/ClothPatch.h"
#include "bullet_wetcloth/shading/Colour.h"
