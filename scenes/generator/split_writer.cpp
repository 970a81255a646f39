#include "scenes/generator/split_writer.h"

namespace firstray::scenes {

SplitWriter::SplitWriter(const Request& request, std::string part, AffWriter& main, std::uint64_t full)
    : request_(request), main_(main), part_(std::move(part)), full_(full)
{
}

AffWriter& SplitWriter::out()
{
    if (file_ && file_->bytes() > full_) finish();
    if (!file_) {
        const std::string rest = part_ + "_" + std::to_string(files_++) + ".aff";
        name_ = request_.name(rest);
        file_.emplace(request_.beside(rest));
    }
    return *file_;
}

void SplitWriter::finish()
{
    if (!file_) return;
    file_->finish();
    main_.include(name_, file_->triangles());
    main_.forget_material();
    file_.reset();
}

}  // namespace firstray::scenes
