#include "engine/grid/visits.h"

namespace firstray::inline v0 {

Visits& Visits::of_this_thread()
{
    thread_local Visits visits;
    return visits;
}

}  // namespace firstray::inline v0
