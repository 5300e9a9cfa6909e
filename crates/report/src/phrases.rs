//! Sentences about conventions in Chinese, phrase by phrase: the page of libraries has both languages,
//! its data one.

/// English phrases in the order in which they are looked for, and the same in Chinese. `{}` is anything;
/// what stood there comes where `{0}`, `{1}` or `{2}` is.
const PHRASES: &[(&str, &str)] = &[
    // What was found at all.
    ("Not asked: a window or range of {} px is needed.", "没有问：需要 {0} px 的窗口或范围。"),
    ("Unexplained", "未能解释"),
    ("unexplained", "未能解释"),
    (": it answered none of {} questions.", "：{0} 个问题一个也没有回答。"),
    (". The nearest hypothesis explains ", "。最接近的假设说明了它 "),
    (" of its triangles: it ", "的三角形："),
    (" of its lines: it ", "的直线："),
    ("; that explains {} of its triangles.", "；这说明了它 {0}的三角形。"),
    ("; that explains {} of its lines.", "；这说明了它 {0}的直线。"),
    // What else was seen.
    (
        "Triangles that leave the window come out otherwise ({} of {}), as where they are cut first; they \
         are left out.",
        "伸出窗口的三角形画得不同（{1} 个里有 {0} 个），像是先被切断过；这些不计入。",
    ),
    (
        "Lines that leave the window come out otherwise ({} of {}), as where they are cut first; they are \
         left out.",
        "伸出窗口的直线画得不同（{1} 条里有 {0} 条），像是先被切断过；这些不计入。",
    ),
    ("The order of the corners changes the answer.", "顶点的次序会改变回答。"),
    ("Triangles without area leave pixels.", "没有面积的三角形也留下像素。"),
    ("It hits pixels of one triangle twice.", "同一个三角形的像素会画到两次。"),
    (" of its lines are the same from either end.", "的直线从两端画都一样。"),
    ("It draws pixels of one line twice.", "同一条直线的像素会画到两次。"),
    (
        "Its pixels do not come in order from the first end.",
        "它的像素不是从第一个端点起依次出来的。",
    ),
    ("It may as well be that it ", "也可能是："),
    // Pictures, windings, corners.
    ("draws its picture upside down, ", "整幅画上下颠倒，"),
    ("draws its picture with left and right exchanged, ", "整幅画左右颠倒，"),
    ("draws its picture turned by half a turn, ", "整幅画转了半圈，"),
    ("draws its picture with x and y exchanged, ", "整幅画 x 与 y 互换，"),
    ("draws clockwise triangles alone, ", "只画顺时针的三角形，"),
    ("draws counterclockwise triangles alone, ", "只画逆时针的三角形，"),
    ("draws nothing, ", "什么也不画，"),
    ("draws nothing.", "什么也不画。"),
    ("moves corners to whole pixels (", "把顶点移到整像素（"),
    ("moves corners to {} px (", "把顶点移到 {0} px 的网格（"),
    ("（the nearest, halves up), ", "（取最近的，正中间向上），"),
    ("（the nearest, halves to the even one), ", "（取最近的，正中间取偶数），"),
    ("（down), ", "（向下取），"),
    ("（toward zero), ", "（向零取），"),
    // Shapes.
    (
        "fills row by row at height {}, from the first column whose {} lies right of the left crossing to \
         the last whose {} lies left of the right one",
        "在高度 {0} 处逐行填充，从列内 {1} 处落在左交点之右的第一列，画到列内 {2} 处落在右交点之左的最后一列",
    ),
    (
        "fills row by row, samples {}, and moves the crossings in fixed-point steps (the first cut to 1/64 px)",
        "逐行填充，采样点{0}，交点以定点数步进（第一个截到 1/64 px）",
    ),
    ("draws every pixel that the triangle touches", "画三角形碰到的每个像素"),
    (
        "samples {} and draws what lies within {} px of the triangle, in both axes at once",
        "采样点{0}，画两个方向上离三角形都不超过 {1} px 的点",
    ),
    (
        "samples {} and draws what lies within {} px of the triangle",
        "采样点{0}，画离三角形不超过 {1} px 的点",
    ),
    (
        "draws a pixel if at least {} % of its area (of an area centred {}) is covered",
        "像素的面积（中心{1}的一块）至少盖住 {0} % 才画",
    ),
    ("draws a pixel if at least {} % of its area is covered", "像素的面积至少盖住 {0} % 才画"),
    (
        "draws a pixel if any of its four samples ({}) are covered",
        "四个采样点（{0}）中有一个被盖住就画像素",
    ),
    (
        "draws a pixel if two of its four samples ({}) are covered",
        "四个采样点（{0}）中有两个被盖住才画像素",
    ),
    (
        "draws a pixel if three of its four samples ({}) are covered",
        "四个采样点（{0}）中有三个被盖住才画像素",
    ),
    (
        "draws a pixel if all of its four samples ({}) are covered",
        "四个采样点（{0}）全被盖住才画像素",
    ),
    ("two by two", "两行两列"),
    ("each in a row and column of its own", "各占一行一列"),
    (", about a middle ", "，中间"),
    (
        "fills between whole pixels, and draws the three sides as lines; a line halfway between two pixels goes ",
        "在整像素之间填充，三条边再画成直线；正在两个像素中间的直线",
    ),
    (
        "fills the rows whose centres it holds, between crossings taken 1/256 px above the centre and cut down \
         to 1/256 px",
        "填充中心在三角形里的各行，交点取在中心之上 1/256 px 处，再向下截到 1/256 px",
    ),
    (
        "samples at the pixel's centre, row by row, between crossings that are stepped from the first one, all \
         cut to 1/1024 px",
        "采样点在像素中心，逐行填充，交点从第一个起逐步累加，都截到 1/1024 px",
    ),
    (
        "fills row by row between crossings stepped in 1/65536 px from the row nearest to a corner, without the \
         last row, and draws the three sides as lines in such steps",
        "逐行填充，交点从离顶点最近的那一行起以 1/65536 px 步进，最后一行不填，三条边再按同样的步子画成直线",
    ),
    (
        "fills every row from the first to the last between crossings rounded to the nearest pixel, halves \
         inwards, and draws on the row of a corner to where the next one begins",
        "从第一行到最后一行逐行填充，交点取最近的整像素，正在中间的向内，顶点所在的行一直画到下一行开始的地方",
    ),
    (
        "moves corners a quarter of a pixel right and down, and samples at the pixel's centre, row by row, \
         between crossings in single precision that are stepped with a remainder of 31 bits",
        "顶点向右、向下各移四分之一像素，采样点在像素中心，逐行填充，交点用单精度算出，再带着 31 位的余数逐行步进",
    ),
    (
        "draws at each step the pixel that holds the minor coordinate of the step before, in 1/65536 px, seen \
         from the end with the smaller major coordinate, which is not drawn",
        "每一步画的像素取上一步的次坐标，以 1/65536 px 计，从主坐标较小的一端看起，该端不画",
    ),
    (
        "cuts the minor coordinate down, half a step ahead where it grows, in 1/65536 px, seen from the end with \
         the smaller major coordinate",
        "次坐标向下截，增大时超前半步，以 1/65536 px 计，从主坐标较小的一端看起",
    ),
    // What lies on an edge.
    (
        " and draws everything on an edge: neighbours are drawn twice",
        "，边上的全画：相邻的三角形会重复",
    ),
    (
        " and draws nothing on an edge: neighbours leave holes",
        "，边上的全不画：相邻的三角形之间有洞",
    ),
    (" and follows the top-left rule", "，遵循左上规则"),
    (" and follows the top-right rule", "，遵循右上规则"),
    (" and follows the bottom-left rule", "，遵循左下规则"),
    (" and follows the bottom-right rule", "，遵循右下规则"),
    (" and follows the top-left, y first rule", "，遵循先看 y 的左上规则"),
    (" and follows the top-right, y first rule", "，遵循先看 y 的右上规则"),
    (" and follows the bottom-left, y first rule", "，遵循先看 y 的左下规则"),
    (" and follows the bottom-right, y first rule", "，遵循先看 y 的右下规则"),
    (" and draws what lies on an edge that faces ", "，画这些朝向的边上的点："),
    ("; what lies on an edge is drawn in no fixed way (", "；边上的点画不画没有定则 ("),
    (", exactly that share in no fixed way", "，恰好这么多时没有定则"),
    (", exactly that share included", "，恰好这么多时也画"),
    (", exactly that share excluded", "，恰好这么多时不画"),
    // Lines.
    ("draws the nearest pixel of each step, a tie goes ", "每一步画最近的像素，平局时"),
    ("cuts the minor coordinate down", "次坐标向下截"),
    ("cuts the minor coordinate up", "次坐标向上截"),
    ("cuts the minor coordinate toward ", "次坐标截向"),
    ("rounds the minor coordinate away from ", "次坐标取整，背离"),
    ("both ends are drawn", "两端都画"),
    ("the last pixel is not drawn", "最后一个像素不画"),
    ("the first pixel is not drawn", "第一个像素不画"),
    ("the right end (of upright lines the lower) is not drawn", "右端（竖直线则为下端）不画"),
    ("neither end is drawn", "两端都不画"),
    (
        "diagonal steps go along the major axis first, seen from {}: 4-connected",
        "斜走的一步先沿主轴（从{0}看）：四连通",
    ),
    (
        "diagonal steps go along the minor axis first, seen from {}: 4-connected",
        "斜走的一步先沿次轴（从{0}看）：四连通",
    ),
    // Ties of lines.
    ("toward larger coordinates", "走向坐标大的一侧"),
    ("toward smaller coordinates", "走向坐标小的一侧"),
    ("to the even pixel", "走向偶数像素"),
    (
        "to the upper pixel of a flat line, to the right one of a steep one",
        "平的线走向上面的像素，陡的线走向右面的",
    ),
    (
        "to the lower pixel of a flat line, to the left one of a steep one",
        "平的线走向下面的像素，陡的线走向左面的",
    ),
    ("not yet, seen from ", "还不走，看的起点是"),
    ("on, seen from ", "就走，看的起点是"),
    ("the first end", "第一个端点"),
    ("the end with the smaller major coordinate", "主坐标较小的一端"),
    ("the left end", "左端"),
    ("the upper end", "上端"),
    // Places.
    ("samples ", "采样点"),
    ("at the pixel's centre", "在像素中心"),
    ("at the pixel's upper left corner", "在像素左上角"),
    ("at the pixel's upper right corner", "在像素右上角"),
    ("at the pixel's lower left corner", "在像素左下角"),
    ("at the pixel's lower right corner", "在像素右下角"),
    ("at ({}) of the pixel", "在像素的 ({0}) 处"),
    // How calls are made.
    (", without antialiasing", "，不抗锯齿"),
    (" with shift 8", "（shift 8）"),
    (" of a Polygon and of a LineString", " 画 Polygon 与 LineString"),
    (" of a filled path at antialiasing level 0", " 画填充的路径，抗锯齿级别 0"),
    (" of Triangles and of Lines", " 画 Triangles 与 Lines"),
    ("Triangle with a fill, Line with a stroke of width 1", "填充的 Triangle，描边宽 1 的 Line"),
    ("alpha from 128 on", "alpha 从 128 起算画到"),
    ("software renderer", "软件渲染器"),
    (" with ", "，"),
    // What is left of sentences.
    ("It ", ""),
    ("it ", ""),
    ("none", "无"),
    ("; ", "；"),
    (". ", "。"),
];

/// A hole is shorter than a sentence.
const MOST_HELD: usize = 120;

/// A sentence, or how a call is made, in Chinese.
#[must_use]
pub fn chinese(text: &str) -> String {
    let mut text = text.to_owned();
    for (english, chinese) in PHRASES {
        let mut from = 0;
        while let Some((start, end, held)) = find(&text, from, english) {
            let mut said = (*chinese).to_owned();
            for (i, held) in held.iter().enumerate() {
                said = said.replace(&format!("{{{i}}}"), held);
            }
            text.replace_range(start..end, &said);
            from = start + said.len();
        }
    }
    match text.strip_suffix('.') {
        Some(whole) => format!("{whole}。"),
        None => text,
    }
}

/// Where a phrase stands at `from` or later, and what stands in its holes.
fn find(text: &str, from: usize, phrase: &str) -> Option<(usize, usize, Vec<String>)> {
    let mut parts = phrase.split("{}");
    let first = parts.next()?;
    let parts: Vec<&str> = parts.collect();
    let starts = text[from..].match_indices(first).map(|(at, _)| from + at);
    starts.into_iter().find_map(|start| {
        let mut at = start + first.len();
        let mut held = Vec::new();
        for part in &parts {
            let length = text[at..].find(part).filter(|length| *length <= MOST_HELD)?;
            held.push(text[at..at + length].to_owned());
            at += length + part.len();
        }
        Some((start, at, held))
    })
}
