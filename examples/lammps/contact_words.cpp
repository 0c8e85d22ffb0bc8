/* A law from the words of an input script.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#include "contact_model.h"

#include <restitute/files.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace restitute_dem
{

static double number(const std::string &word)
{
    double value = NAN;
    const char *end = word.data() + word.size();
    const auto read = std::from_chars(word.data(), end, value); /* whatever the locale */
    if (read.ec != std::errc() || read.ptr != end || std::isnan(value))
        throw std::invalid_argument("'" + word + "': must be a number");
    return value;
}

static double not_negative(const std::string &word)
{
    const double value = number(word);
    if (!(value >= 0 && value <= 1e60)) throw std::invalid_argument("'" + word + "': must be in [0, 1e60]");
    return value;
}

static int whole(const std::string &word)
{
    const double value = number(word);
    if (value != std::floor(value) || std::fabs(value) > 1e6)
        throw std::invalid_argument("'" + word + "': must be a whole number");
    return (int)value;
}

/* Without the library's name of the struct: its members are words of the script. */
static void demand(int status, const restitute_error &error)
{
    if (status >= 0) return;
    std::string text = error.message;
    if (text.compare(0, 8, "options.") == 0) text.erase(0, 8);
    throw std::invalid_argument(text);
}

ContactModel::ContactModel(const std::vector<std::string> &words, const Units &units) : words(words)
{
    restitute_contact_law_options options;
    std::string partner;
    restitute_contact_law_options_init(&options);
    restitute_contact_motion_init(&motion);
    restitute_contact_rates_init(&rates);
    try {
        read(units, options, partner);
        options.deformable = partner == "" ? RESTITUTE_BOTH_BODIES_DEFORM : RESTITUTE_ONE_BODY_DEFORMS;
        if (partner != "" && partner != "rigid") join(partner, units);
        demand(restitute_contact_law_create(material, &options, &law, &error), error);
        remark = error.message;
        measure_stiffness(options.deformable);
    } catch (...) {
        restitute_material_destroy(material);
        throw;
    }
}

ContactModel::~ContactModel()
{
    restitute_contact_law_destroy(law);
    restitute_material_destroy(material);
}

void ContactModel::read(const Units &units, restitute_contact_law_options &options, std::string &partner)
{
    size_t i = 0;
    const auto next = [&]() {
        if (++i >= words.size()) throw std::invalid_argument("'" + words[i - 1] + "': something must follow");
        return words[i];
    };
    const auto one_of = [&](const std::string &first, const std::string &second) {
        const std::string &its = words[i], found = next();
        if (found != first && found != second)
            throw std::invalid_argument("'" + its + " " + found + "': must be " + its + " " + first +
                                        (second == "" ? "" : " or " + second));
        return found == first;
    };
    const auto sds = [&]() {
        const double stiffness = not_negative(next()), damping = not_negative(next());
        return Slider{stiffness, damping, not_negative(next())};
    };
    if (words.empty()) throw std::invalid_argument("the file of a material is missing");
    for (motion.friction = -1, i = 1; i < words.size(); i++) {
        const std::string &word = words[i];
        if (word == "friction")
            motion.friction = number(next());
        else if (word == "partner")
            partner = next();
        else if (word == "elements")
            options.elements = whole(next());
        else if (word == "terms")
            options.terms = whole(next());
        else if (word == "window")
            options.shortest = number(next()), options.longest = number(next());
        else if (word == "rolling")
            one_of("sds", ""), resistance.rolling = sds(), resistance.rolls = true;
        else if (word == "twisting") {
            resistance.is_marshall = one_of("marshall", "sds"), resistance.twists = true;
            if (!resistance.is_marshall) resistance.twisting = sds();
        } else if (word == "details")
            has_details = one_of("yes", "no");
        else if (word == "slip_cycles")
            options.slip_cycles = one_of("yes", "no");
        else if (word == "speed")
            speed = not_negative(next());
        else if (word == "limits")
            limits[RADIUS] = not_negative(next()), limits[SPEED] = not_negative(next());
        else
            throw std::invalid_argument("'" + word +
                                        "': must be friction, partner, elements, terms, window, rolling, twisting, "
                                        "details, slip_cycles, speed or limits");
    }
    if (!(motion.friction >= 0 && motion.friction <= 1e6))
        throw std::invalid_argument("'friction MU' is required, with MU in [0, 1e6]");
    options.frictionless = motion.friction == 0;
    options.details = has_details;
    open(words[0], units, &material);
}

/* A material in units of the host. */
void ContactModel::open(const std::string &file, const Units &units, restitute_material **opened)
{
    restitute_material *si;
    restitute_material_info info;
    double g_inf, eta;
    restitute_material_info_init(&info);
    demand(restitute_material_read(file.c_str(), &si, &info, &error), error);
    if (info.density > 0) file_density = std::max(file_density, info.density / units.density);
    const size_t n = restitute_material_terms(si);
    std::vector<double> tau(n + 1), g(n + 1);
    restitute_material_series(si, &g_inf, &eta, tau.data(), g.data(), nullptr);
    for (double &modulus : g)
        modulus /= units.stress;
    const int status = restitute_material_prony(g_inf / units.stress, eta / units.stress, n, tau.data(), g.data(),
                                                restitute_material_poisson_ratio(si), opened, &error);
    restitute_material_destroy(si);
    demand(status, error);
}

/* Makes one solid of the material and that of the partner. */
void ContactModel::join(const std::string &partner, const Units &units)
{
    restitute_material *other, *effective;
    open(partner, units, &other);
    const int status = restitute_material_effective(material, other, &effective, &error);
    restitute_material_destroy(other);
    demand(status, error);
    restitute_material_destroy(material);
    material = effective;
}

/* Marshall's twisting takes the tangential stiffness of a contact that sticks, 8 G* a = 4 G a/(2 -
 * nu) for two bodies of one material, from docs/contact.md, eq. (9). G is that of all springs: what
 * a twist meets that is fast for the material. In slow twists springs relax, but what holds then is
 * the slider, whose limit does not depend on G. The dashpot of the material damps. */
void ContactModel::measure_stiffness(int bodies)
{
    double modulus, viscosity, g[8];
    size_t n;
    restitute_contact_law_series(law, &modulus, &viscosity, &n, nullptr, g, nullptr, nullptr);
    for (size_t k = 0; k < n; k++)
        modulus += g[k];
    const double shape = 8 / (2 - restitute_material_poisson_ratio(material)) / bodies;
    resistance.tangential = {shape * modulus, shape * viscosity, motion.friction};
}

std::string ContactModel::about() const
{
    size_t kept;
    double bound;
    char text[200];
    restitute_contact_law_series(law, nullptr, nullptr, &kept, nullptr, nullptr, &bound, nullptr);
    std::snprintf(text, sizeof text, ": law %016llx, %zu of %zu terms, G(t) within %.2g %%, %d numbers a contact",
                  (unsigned long long)hash(), kept, restitute_material_terms(material), 100 * bound, history_size());
    const std::string warning = remark.empty() ? "" : "WARNING: restitute: " + words[0] + ": " + remark + "\n";
    return "restitute: " + words[0] + text + "\n" + warning;
}

uint64_t ContactModel::hash() const
{
    return restitute_contact_law_hash(law) ^ (has_resistance() ? 0x9e3779b97f4a7c15 : 0); /* sizes differ */
}

int ContactModel::history_size() const
{
    return 1 + (int)restitute_contact_law_state_size(law) + resistance.history_size();
}

} // namespace restitute_dem
