#include "Radiosity/Core/LeafMesh.h"
