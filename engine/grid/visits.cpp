#include "engine/grid/visits.h"

namespace firstray {

Visits& Visits::of_this_thread()
{
    thread_local Visits visits;
    return visits;
}

}  // namespace firstray
