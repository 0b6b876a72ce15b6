# collada: почему файл не принят
collada-too-large = Файл больше { $limit } МБ — это предел для чтения.
collada-cancelled = Чтение отменено.
collada-not-xml = Это не документ XML, а значит, и не COLLADA.
collada-not-collada = Корень документа — <{ $element }>, а документ COLLADA начинается с <COLLADA>.
collada-too-many-elements = В документе слишком много элементов для его размера ({ $count }).
collada-too-deep = Вложенность элементов больше { $limit } уровней.
collada-too-many-attributes = У элемента больше { $limit } атрибутов.
collada-too-many-prefixes = В документе объявлено больше { $limit } префиксов пространств имён.
collada-entities = Сущности документа развернулись бы более чем в { $limit } МБ.
collada-comma = { $element }: в «{ $entry }» числа разделены запятой. В COLLADA числа разделяются пробелами; экспортируйте файл заново.
collada-xml = Ошибка XML в столбце { $column }.
collada-xml-close-tag = Ошибка XML: ожидался </{ $expected }>, а стоит </{ $actual }>.
collada-xml-cut-short = XML обрывается на середине: файл неполон.
collada-xml-unknown-entity = В XML использована необъявленная сущность &{ $name };.
collada-xml-entity-loop = Сущности XML бесконечно ссылаются друг на друга.
collada-xml-unknown-prefix = В XML использован необъявленный префикс «{ $prefix }».
collada-xml-repeated-attribute = Атрибут «{ $name }» указан у элемента дважды.
collada-archive-broken = Архив повреждён, распаковать его нельзя.
collada-archive-files = В архиве больше { $limit } файлов.
collada-archive-large = Распакованный архив потребовал бы больше памяти, чем позволено: { $limit } его размеров и ещё 64 МБ. Распакуйте его и откройте сам документ.
collada-archive-empty = В архиве нет документа COLLADA.
collada-archive-root = Манифест архива называет «{ $path }», но такого файла в архиве нет.

# collada: замечания
collada-encoding = Байты не в кодировке { $named }; прочитано как Windows-1252, поэтому буквы в именах могут быть искажены.
collada-unknown-version = Версия «{ $version }» неизвестна; прочитано как 1.4.1.
collada-bad-unit = Единица «{ $value }» — не положительное число; принят 1 метр.
collada-bad-up-axis = Ось «{ $value }» — не X_UP, Y_UP или Z_UP; принята Y_UP.
collada-repeated-id = Такой id уже есть у другого элемента; ссылки ведут к ближайшему подходящему.
collada-undeclared-prefix = Префикс пространства имён «{ $prefix }» нигде не объявлен; имена читаются без него.
collada-broken-reference = Ссылка на «{ $target }», которого нет в файле; пропущено.
collada-wrong-reference = Ссылка на «{ $target }» ведёт к <{ $tag }>, которому здесь не место; пропущено.
collada-external-reference = Ссылка на другой файл, «{ $file }»; он не загружается.
collada-part-broken = Этот документ архива прочитать нельзя: { $reason }
collada-part-entities = В нём объявлены собственные сущности.
collada-reference-cycle = Ссылка замыкается сама на себя; пропущено.
collada-decimal-comma = В числах стоит десятичная запятая, первое из них — «{ $entry }»; она прочитана как точка.
collada-bad-number = { $count ->
    [one] { $count } запись не является числом, первая — «{ $first }»; вместо неё взят 0.
    [few] { $count } записи не являются числами, первая — «{ $first }»; вместо них взят 0.
   *[other] { $count } записей не являются числами, первая — «{ $first }»; вместо них взят 0.
}
collada-not-finite = Значение бесконечно или не является числом; пропущено.
collada-not-finite-points = Координаты точек бесконечны или не являются числами; всё, что на них опирается, не рисуется.
collada-not-finite-keys = Ключи бесконечны или не являются числами; они пропущены.
collada-count-mismatch = В count указано { $said }, а данных { $found }; взяты данные.
collada-index-out-of-range = { $count ->
    [one] { $count } грань указывает за пределы своих списков; она пропущена.
    [few] { $count } грани указывают за пределы своих списков; они пропущены.
   *[other] { $count } граней указывают за пределы своих списков; они пропущены.
}
collada-values-out-of-range = { $count ->
    [one] { $count } вершина указывает за пределы списков нормалей, текстурных координат или цветов; она рисуется без них, нормаль вычислена.
    [few] { $count } вершины указывают за пределы списков нормалей, текстурных координат или цветов; они рисуются без них, нормали вычислены.
   *[other] { $count } вершин указывают за пределы списков нормалей, текстурных координат или цветов; они рисуются без них, нормали вычислены.
}
collada-not-finite-values = { $count ->
    [one] У { $count } вершины нормаль, текстурная координата или цвет бесконечны или не являются числом; она рисуется без них, нормаль вычислена.
   *[other] У { $count } вершин нормали, текстурные координаты или цвета бесконечны или не являются числами; они рисуются без них, нормали вычислены.
}
collada-not-finite-weights = { $count ->
    [one] { $count } вес бесконечен или не является числом; он пропущен.
    [few] { $count } веса бесконечны или не являются числами; они пропущены.
   *[other] { $count } весов бесконечны или не являются числами; они пропущены.
}
collada-no-faces = В сетке нет ни граней, ни линий, поэтому рисовать нечего.
collada-empty-list = Список пуст; то, что на него ссылается, обходится без него.
collada-incomplete-primitive = { $count ->
    [one] У { $count } грани слишком мало вершин; она пропущена.
   *[other] У { $count } граней слишком мало вершин; они пропущены.
}
collada-polygon-too-complex = { $count ->
    [one] { $count } многоугольник слишком сложен для разбиения на треугольники; он пропущен.
    [few] { $count } многоугольника слишком сложны для разбиения на треугольники; они пропущены.
   *[other] { $count } многоугольников слишком сложны для разбиения на треугольники; они пропущены.
}
collada-no-positions = У сетки нет координат вершин; она не рисуется.
collada-unsupported-geometry = Геометрия вида <{ $kind }> не показывается.
collada-too-many-uv-sets = Наборов текстурных координат больше { $limit }; остальные пропущены.
collada-no-scene-named = Файл не указывает, какую сцену показать; показана первая.
collada-no-scene = В файле нет сцены; его части показаны как есть.
collada-bottom-row = Последняя строка матрицы отличается от 0 0 0 1; вместо неё взяты эти числа.
collada-bad-transform = Нужно чисел: { $wanted }, а есть { $found }; пропущено.
collada-unsupported-element = <{ $element }> не показывается: кинематика и формулы здесь ничего не двигают.
collada-limit-nodes = В сцене больше { $nodes } узлов или больше { $depth } уровней; остальное пропущено.
collada-morph-depth = Формы морфа строятся одна из другой на глубину больше { $limit }; остальное пропущено.
collada-limit-reached = Сцена слишком разрастается для размера файла; остальное пропущено.
collada-limit-drawn = Рисование всех экземпляров заняло бы больше { $limit } МБ памяти; остальные пропущены.
collada-joint-not-found = { $count ->
    [one] В сцене нет { $count } сустава («{ $first }»); он остаётся в позе привязки.
   *[other] В сцене нет { $count } суставов, первый — «{ $first }»; они остаются в позе привязки.
}
collada-bind-scale = Скин «{ $skin }» и его кости в покое не сходятся: обратная матрица привязки сустава «{ $joint }» меняет его размер в { $factor } раза, и ни один узел этого не возмещает.
collada-bind-node-scale = Скин «{ $skin }» и его кости в покое не сходятся: сустав «{ $joint }» делает его в { $factor } раза больше, чем узел, на котором он висит, а за своим узлом скин не следует.
collada-bind-node-turn = Скин «{ $skin }» и его кости в покое не сходятся: сустав «{ $joint }» поворачивает его на { $angle }° относительно узла, на котором он висит, а за своим узлом скин не следует.
collada-skeleton-not-in-scene = Скелет не входит в сцену; он добавлен в неё.
collada-joint-names-rejoined = В именах суставов есть пробелы; имена собраны заново.
collada-joint-count = Имён суставов { $names }, а обратных матриц привязки { $matrices }; взяты те, у которых есть и то и другое.
collada-bad-skin = У скина нет пригодного { $what }; сетка показана без него.
collada-no-weights = У скина нет пригодного WEIGHT; сетка остаётся в форме привязки.
collada-no-inverse-bind = У скина нет пригодного INV_BIND_MATRIX; считается, что его суставы привязаны в начале координат.
collada-second-skin = На сетке скин поверх скина; используется только ближний к сетке.
collada-nothing-to-show = В файле нет ни сцены, ни геометрии: показывать нечего.
collada-stride-mismatch = В stride указано { $said }, а param занимают { $found }; взято { $found }.
collada-skin-points = Веса заданы для { $found } точек, а в сетке их { $wanted }; точки без весов остаются в форме привязки.
collada-influences-out-of-range = { $count ->
    [one] { $count } вес указывает на несуществующий сустав или значение; он пропущен.
    [few] { $count } веса указывают на несуществующие суставы или значения; они пропущены.
   *[other] { $count } весов указывают на несуществующие суставы или значения; они пропущены.
}
collada-influences-missing = { $count ->
    [one] В конце списка не хватает { $count } веса.
   *[other] В конце списка не хватает { $count } весов.
}
collada-weights-not-normalised = { $count ->
    [one] Сумма весов { $count } точки не равна 1; веса приведены к единице.
   *[other] Сумма весов { $count } точек не равна 1; веса приведены к единице.
}
collada-empty-controller = В контроллере нет ни скина, ни морфа; пропущен.
collada-bad-morph = У морфа нет списка целей; пропущен.
collada-morph-weights = Весов у морфа меньше, чем форм; вместо недостающих взят 0.
collada-morph-target = В форме «{ $target }» точек { $found }, а в основе { $wanted }; форма не используется.
collada-unknown-target = Анимирует «{ $target }», которого нет в сцене; пропущено.
collada-unsupported-target = Движет «{ $target }», а это движение не показывается; пропущено.
collada-bad-sampler = У сэмплера нет пригодных моментов времени или значений; пропущено.
collada-key-counts = Моментов { $times }, а значений { $values }; взяты ключи, у которых есть и то и другое.
collada-key-size = В ключе чисел { $found }, а нужно { $wanted }; пропущено.
collada-unsupported-interpolation = Интерполяция { $name } прочитана как LINEAR.
collada-missing-tangents = У кривых ключей нет пригодных касательных; прочитано как LINEAR.
collada-sheared-keys = В матрицах-ключах есть сдвиг; они интерполируются поэлементно.
collada-empty-clip = Клип ничего не двигает; пропущен.
collada-unbound-material = Материал «{ $symbol }» сетки ни к чему не привязан; взят нейтральный.
collada-texture-not-found = Текстура «{ $name }» не ведёт к изображению; пропущена.
collada-no-common-profile = У эффекта нет общего профиля; взят нейтральный материал.
collada-transparency-inverted = Если читать буквально, материал был бы невидим; прозрачность понята наоборот.
collada-bad-light = Вид источника света неизвестен; пропущен.
collada-bad-camera = У камеры нет проекции; пропущена.
finding-more-places = { $count ->
    [one] То же ещё { $count } раз в этом файле.
    [few] То же ещё { $count } раза в этом файле.
   *[other] То же ещё { $count } раз в этом файле.
}
collada-more-findings = { $count ->
    [one] Ещё { $count } замечание; хранятся только первые { $limit }.
    [few] Ещё { $count } замечания; хранятся только первые { $limit }.
   *[other] Ещё { $count } замечаний; хранятся только первые { $limit }.
}

# collada: имена для безымянного
collada-clip-default = Анимация
collada-clip-number = Клип { $number }
collada-unnamed-node = Узел { $number }
collada-unnamed-mesh = Сетка
collada-unnamed-skin = Скин
collada-unnamed-morph = Морф
collada-unnamed-material = Материал
collada-unnamed-image = Изображение
collada-unnamed-light = Свет
collada-unnamed-camera = Камера
