#include "engine/grid/beam.h"

#include <memory>

namespace firstray {

Mailbox& Mailbox::of_this_thread()
{
    thread_local Mailbox mailbox;
    return mailbox;
}

BeamRays& beam_rays_of_this_thread()
{
    thread_local const std::unique_ptr<BeamRays> rays = std::make_unique<BeamRays>();
    return *rays;
}

}  // namespace firstray
