// Edges: blackens the edges of a picture on a GPU, after its first hits. The batch is the whole picture, row-major,
// with CHANNEL_DISTANCE, CHANNEL_NORMAL and CHANNEL_IDS.
#include "traversal/camera.h"
#include "shading/edge.h"

// `surfaces`: the picture from CHANNEL_DISTANCE on; x, y: within the screen.
static edge_pixel pixel_of_picture(__global const Frame* frame, edge_camera camera, __global const float* surfaces,
                                   int x, int y) {
    const size_t size = channel_size(frame);
    edge_pixel p;
    surfaces += (size_t)y * width_of(frame->screen) + x;
    p.distance = surfaces[0];
    p.nx = surfaces[size];
    p.ny = surfaces[2 * size];
    p.nz = surfaces[3 * size];
    p.region = ((__global const u32*)surfaces)[4 * size];
    return edge_pixel_at(camera, (float)x, (float)y, p);
}

// edge_between of a pixel and the next to the right, or below; 0 outside of the screen.
static u32 edge_after(__global const Frame* frame, edge_camera camera, __global const float* surfaces, int x, int y,
                      int down) {
    const int right = !down;
    edge_pixel a, b;
    if (x < 0 || y < 0 || x + right >= (int)width_of(frame->screen) || y + down >= (int)frame->rows) return 0;
    a = pixel_of_picture(frame, camera, surfaces, x, y);
    b = pixel_of_picture(frame, camera, surfaces, x + right, y + down);
    return edge_between(a, down ? a.down : a.right, b, down ? b.down : b.right, camera.slack);
}

// One work-item a pixel, in the order of the rays. Nothing is done if some rays are not drawn: the host sees the same
// count in the report.
__kernel void draw_edges(__global const Frame* frame, __global const BatchReport* report, __global float* picture) {
    const u32 id = (u32)get_global_id(0), channels = frame->channels;
    const size_t size = channel_size(frame);
    __global const float* const surfaces = picture + (channels & CHANNEL_COLOR ? 4 * size : 0);
    __global u32* const display = (__global u32*)surfaces + (channels & CHANNEL_COUNTS ? 9 : 6) * size;
    edge_camera camera;
    pixel_position at;
    size_t place;
    int x, y, down;
    u32 is_black = 0;
    if (id >= frame->ray_count || report->overflows) return;
    if (!((__global const unsigned char*)(report + 1))[id / (TILE * TILE)]) return;  // the tile shows nothing
    at = pixel_of(id, frame->screen);
    if (!at.inside) return;
    x = (int)(at.x - frame->screen.left);
    y = (int)(at.y - frame->screen.top);
    camera = edge_camera_of(frame);
    for (down = 0; down < 2; ++down) {
        const int right = !down;
        const u32 before = edge_after(frame, camera, surfaces, x - right, y - down, down) & 2u,
                  after = edge_after(frame, camera, surfaces, x, y, down) & 1u;
        if (!(before | after)) continue;
        if (edge_is_thin(before, after, edge_after(frame, camera, surfaces, x + right, y + down, down) & 1u,
                         edge_after(frame, camera, surfaces, x - 2 * right, y - 2 * down, down) & 2u))
            return;
        is_black = 1;
    }
    if (!is_black) return;
    place = row_major_place(frame->screen, 0, at);
    if (channels & CHANNEL_COLOR) picture[place] = picture[size + place] = picture[2 * size + place] = 0;
    if (channels & CHANNEL_DISPLAY) display[place] = EDGE_WORD;
}
