#pragma once

// Everything that an application needs to make its Bullet cloth wet.

#include "bullet_wetcloth/Fabric.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/effects/Absorption.h"
#include "bullet_wetcloth/effects/CollisionAudit.h"
#include "bullet_wetcloth/effects/Diffusion.h"
#include "bullet_wetcloth/effects/Dripping.h"
#include "bullet_wetcloth/effects/Drying.h"
#include "bullet_wetcloth/effects/HookeSprings.h"
#include "bullet_wetcloth/effects/Immersion.h"
#include "bullet_wetcloth/effects/Rain.h"
#include "bullet_wetcloth/effects/Seepage.h"
#include "bullet_wetcloth/effects/Splash.h"
#include "bullet_wetcloth/effects/Swelling.h"
#include "bullet_wetcloth/effects/WaterDrag.h"
#include "bullet_wetcloth/effects/WetFriction.h"
#include "bullet_wetcloth/effects/WetStiffness.h"
#include "bullet_wetcloth/effects/Wind.h"
#include "bullet_wetcloth/mesh/ClothPatch.h"
#include "bullet_wetcloth/shading/Colour.h"
