#include "vtkRadiosityArrays.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkRadiosityArrays);
