#include "engine/render/render.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "engine/core/errors.h"
#include "engine/render/camera_rays.h"
#include "engine/render/ray_tree.h"

namespace firstray::inline v0 {
namespace {

/// Pixels that a task of render_pixels takes: enough for beams, few enough that a 64th of a picture still makes tasks
/// for several threads.
constexpr std::size_t lot_size = 64;

void check(const Pose& pose, std::span<const Texture> textures, const RenderOptions& options)
{
    if (options.width < 1 || options.height < 1) throw std::invalid_argument("a picture needs at least one pixel");
    if (options.samples < 1) throw std::invalid_argument("a pixel needs at least one sample");
    if (options.depth < 0) throw std::invalid_argument("the depth of rays cannot be negative");
    if (textures.size() != pose.scene->textures.size())
        throw std::invalid_argument("the scene has " + std::to_string(pose.scene->textures.size()) + " textures, not " +
                                    std::to_string(textures.size()));
}

void check_cancelled(const RenderOptions& options)
{
    if (options.cancelled && options.cancelled()) throw Cancelled();
}

void resize(Frame& frame, const RenderOptions& options)
{
    frame.width = options.width;
    frame.height = options.height;
    const std::size_t pixels = frame.pixel_count(), metered = options.costs ? pixels : 0;
    frame.colour.assign(pixels, glm::vec3(0.0f));
    frame.distance.assign(pixels, std::numeric_limits<float>::infinity());
    frame.primitive.assign(pixels, no_primitive);
    frame.group.assign(pixels, none);
    frame.age.assign(pixels, 0);
    frame.cells.assign(metered, 0);
    frame.tests.assign(metered, 0);
    frame.nanoseconds.assign(metered, 0.0f);
}

/// Refuses a frame that was not rendered with the same options, or pixels outside of it.
void check_former(const Frame& frame, std::span<const glm::ivec2> pixels, const RenderOptions& options)
{
    const std::size_t count = frame.pixel_count();
    if (frame.width != options.width || frame.height != options.height || frame.colour.size() != count ||
        frame.nanoseconds.size() != (options.costs ? count : 0))
        throw std::invalid_argument("the former frame was rendered with other options");
    const auto is_outside = [&](glm::ivec2 p) {
        return p.x < 0 || p.y < 0 || p.x >= frame.width || p.y >= frame.height;
    };
    if (std::any_of(pixels.begin(), pixels.end(), is_outside))
        throw std::invalid_argument("a pixel to be traced lies outside the picture");
}

/// What one thread needs to render some pixels; reused from one lot to the next.
template <typename Real>
struct Workspace {
    RayTree<Real> tree;
    std::vector<glm::ivec2> pixels{};  ///< in hand, at most RayTile::capacity
    std::vector<glm::vec3> colours{};  ///< by pixel in hand
};

/// Workspaces that no thread uses at the moment: there are never more than threads.
template <typename T>
class Pool {
public:
    /// One from the pool, or null where all are in use.
    std::unique_ptr<T> take()
    {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return nullptr;
        std::unique_ptr<T> item = std::move(free_.back());
        free_.pop_back();
        return item;
    }
    void give(std::unique_ptr<T> item)
    {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(item));
    }
    const std::vector<std::unique_ptr<T>>& items() const { return free_; }

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<T>> free_;
};

/// One frame in the making.
template <typename Real>
class FrameRenderer {
public:
    FrameRenderer(const Strategy<Real>& strategy, const Pose& pose, std::span<const Texture> textures,
                  const RenderOptions& options, Frame& frame)
        : strategy_(strategy),
          pose_(pose),
          textures_(textures),
          options_(options),
          camera_(camera_rays(pose, options.width, options.height)),
          places_(sample_places(options.samples)),
          frame_(frame)
    {
    }

    // Lots write to pixels of their own, so any number may be rendered at once.

    void render_tile(glm::ivec2 tile)
    {
        render_lot(
            [&](std::vector<glm::ivec2>& pixels) { tile_pixels(tile, options_.width, options_.height, pixels); });
    }

    /// pixels  at most RayTile::capacity
    void render_pixels(std::span<const glm::ivec2> lot)
    {
        render_lot([&](std::vector<glm::ivec2>& pixels) { pixels.assign(lot.begin(), lot.end()); });
        for (const glm::ivec2 pixel : lot) frame_.age[index(pixel)] = 0;
    }

    RayCounts counts() const
    {
        RayCounts sum;
        for (const auto& work : pool_.items()) sum += work->tree.counts();
        return sum;
    }

private:
    template <typename Fill>
    void render_lot(const Fill& fill)
    {
        std::unique_ptr<Workspace<Real>> work = pool_.take();
        if (!work) work.reset(new Workspace<Real>{{strategy_, pose_, textures_, options_.depth, options_.costs}});
        fill(work->pixels);
        work->colours.assign(work->pixels.size(), glm::vec3(0.0f));
        for (std::size_t sample = 0; sample < places_.size(); ++sample) {
            aim(camera_, work->pixels, places_[sample], work->tree.primary());
            work->tree.trace(work->colours);
            if (sample == 0) write_hits(*work);
            if (options_.costs) add_costs(*work, sample == 0);
        }
        write_colours(*work);
        pool_.give(std::move(work));
    }

    std::size_t index(glm::ivec2 pixel) const
    {
        return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(frame_.width) +
               static_cast<std::size_t>(pixel.x);
    }

    void write_hits(Workspace<Real>& work)
    {
        const RayTile<Real>& rays = work.tree.primary();
        for (std::size_t i = 0; i < work.pixels.size(); ++i) {
            const std::size_t at = index(work.pixels[i]);
            const bool hit = rays.primitive[i] != no_primitive;
            frame_.distance[at] = hit ? static_cast<float>(rays.t_max[i]) : std::numeric_limits<float>::infinity();
            frame_.primitive[at] = rays.primitive[i];
            frame_.group[at] = hit ? pose_.scene->part(rays.primitive[i]).group : none;
        }
    }

    void add_costs(const Workspace<Real>& work, bool is_first)
    {
        for (std::size_t i = 0; i < work.pixels.size(); ++i) {
            const RayCost& cost = work.tree.costs()[i];
            const std::size_t at = index(work.pixels[i]);
            if (is_first) {
                frame_.cells[at] = frame_.tests[at] = 0;
                frame_.nanoseconds[at] = 0.0f;
            }
            frame_.cells[at] += cost.cells;
            frame_.tests[at] += cost.tests;
            frame_.nanoseconds[at] += static_cast<float>(cost.nanoseconds);
        }
    }

    void write_colours(const Workspace<Real>& work)
    {
        const auto samples = static_cast<float>(places_.size());
        for (std::size_t i = 0; i < work.pixels.size(); ++i)
            frame_.colour[index(work.pixels[i])] = glm::clamp(work.colours[i] / samples, 0.0f, 1.0f);
    }

    const Strategy<Real>& strategy_;
    const Pose& pose_;
    std::span<const Texture> textures_;
    const RenderOptions& options_;
    CameraRays camera_;
    std::vector<glm::dvec2> places_;
    Frame& frame_;
    Pool<Workspace<Real>> pool_;
};

}  // namespace

RayCounts& RayCounts::operator+=(const RayCounts& other)
{
    primary += other.primary;
    shadow += other.shadow;
    reflected += other.reflected;
    transmitted += other.transmitted;
    return *this;
}

template <typename Real>
RayCounts render(const Strategy<Real>& strategy, const Pose& pose, std::span<const Texture> textures,
                 const RenderOptions& options, const Executor& executor, Frame& frame)
{
    check(pose, textures, options);
    resize(frame, options);
    FrameRenderer<Real> renderer(strategy, pose, textures, options, frame);
    const glm::ivec2 tiles = tile_counts(options.width, options.height);
    executor.for_each(static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y), [&](std::size_t tile) {
        check_cancelled(options);
        const auto columns = static_cast<std::size_t>(tiles.x);
        renderer.render_tile({static_cast<int>(tile % columns), static_cast<int>(tile / columns)});
    });
    return renderer.counts();
}

template <typename Real>
RayCounts render_pixels(const Strategy<Real>& strategy, const Pose& pose, std::span<const Texture> textures,
                        const RenderOptions& options, const Executor& executor, std::span<const glm::ivec2> pixels,
                        Frame& frame)
{
    check(pose, textures, options);
    check_former(frame, pixels, options);
    for (std::uint32_t& age : frame.age) ++age;
    FrameRenderer<Real> renderer(strategy, pose, textures, options, frame);
    executor.for_pieces(pixels.size(), lot_size, [&](std::size_t begin, std::size_t end) {
        check_cancelled(options);
        renderer.render_pixels(pixels.subspan(begin, end - begin));
    });
    return renderer.counts();
}

template RayCounts render<float>(const Strategy<float>&, const Pose&, std::span<const Texture>, const RenderOptions&,
                                 const Executor&, Frame&);
template RayCounts render<double>(const Strategy<double>&, const Pose&, std::span<const Texture>, const RenderOptions&,
                                  const Executor&, Frame&);
template RayCounts render_pixels<float>(const Strategy<float>&, const Pose&, std::span<const Texture>,
                                        const RenderOptions&, const Executor&, std::span<const glm::ivec2>, Frame&);
template RayCounts render_pixels<double>(const Strategy<double>&, const Pose&, std::span<const Texture>,
                                         const RenderOptions&, const Executor&, std::span<const glm::ivec2>, Frame&);

}  // namespace firstray::inline v0
